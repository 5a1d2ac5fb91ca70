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

int convert(const Request& request, Context& context) {
  check_can_write(request.output);
  const Scan scan = load_scan(request.scan, context);
  topography::write(scan.surface, request.output);
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
              "The format follows the extension of OUT: .h5 .gwy .gsf .sdf .x3p .npy .txt "
              ".xyz .vti.",
          .examples = {"tabor convert surfaces/edt_before.x3p edt.gwy",
                       "tabor convert surfaces/edt_before.x3p edt.h5 --level plane --lowpass "
                       "gauss:8um"},
          .declare = [](OptionSet& set) -> Action {
            const auto request = std::make_shared<Request>();
            declare_scan(set, request->scan);
            set.group("Output");
            set.positional("OUT", "the file to write", request->output);
            return [request](Context& context) { return convert(*request, context); };
          }};
}

}  // namespace tabor::cli
