#include <chrono>
#include <future>
#include <limits>
#include <memory>

#include "tabor/cli/result.hpp"
#include "tabor/cli/table.hpp"
#include "tabor/cli/verbs.hpp"

namespace tabor::cli {

namespace {

struct Request {
  ScanRequest scan;
  std::string output;
};

/// Writes while the observer is told that it takes its time: packing a large map is slow and says
/// nothing itself. A file that is being written when the user interrupts is finished first.
void write(const topography::Topography& surface, const std::string& file,
           const Observer& observer) {
  constexpr std::chrono::milliseconds kPeriod{200};
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  std::future<void> writing = std::async(std::launch::async, [&] { scan::write(surface, file); });
  while (writing.wait_for(kPeriod) != std::future_status::ready) {
    report_progress(observer, "write " + file, kUnknown);
  }
  writing.get();
}

int convert(const Request& request, Context& context) {
  const Scan scan = read_scan(request.scan, context);
  analysis::Case doubts = doubts_of(scan);
  std::erase_if(doubts.warnings, [](const auto& one) { return one.code == "not-levelled"; });
  context.warn(analysis::findings_of({doubts}));
  write(scan.surface, request.output, context.observer());
  io::Json object = json_head(context, scan);
  object["output"] = request.output;
  object["nx"] = scan.surface.grid.nx;
  object["ny"] = scan.surface.grid.ny;
  object["missing_pixels"] = topography::count_holes(scan.surface);
  Facts facts;
  describe(scan, facts);
  facts.fact("written", request.output);
  return finish(context, object, facts.text());
}

}  // namespace

Verb convert_verb() {
  return {.name = "convert",
          .arguments = "SCAN OUT [options]",
          .summary = "treat a scan and write it in another format",
          .details =
              "The format follows the extension of OUT: .h5 .gwy .gsf .sdf .asdf .x3p .npy "
              ".txt .xyz .vti.",
          .examples = {"tabor convert surfaces/edt_before.x3p edt.gwy",
                       "tabor convert surfaces/edt_before.x3p edt.h5 --level plane --lowpass "
                       "gauss:8um"},
          .declare = [](OptionSet& set) -> Action {
            const auto request = std::make_shared<Request>();
            declare_scan(set, request->scan);
            set.group("Output");
            Option& out = set.positional("OUT", "the file to write", request->output);
            out.names = FileRole::output;
            out.extensions = scan_extensions();
            return [request](Context& context) { return convert(*request, context); };
          }};
}

}  // namespace tabor::cli
