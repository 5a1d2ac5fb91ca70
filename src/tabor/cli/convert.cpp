#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <future>
#include <limits>
#include <memory>

#include "tabor/cli/result.hpp"
#include "tabor/cli/table.hpp"
#include "tabor/cli/verbs.hpp"
#include "tabor/core/error.hpp"
#include "tabor/core/text.hpp"
#include "tabor/scan/read_parameters.hpp"
#include "tabor/study/study_maps.hpp"

namespace tabor::cli {

namespace {

struct Request {
  ScanRequest scan;
  std::string output;
  std::optional<std::string> field;  ///< a map of a result, and not the heights of a scan
  results::MapChoice choice;
  std::optional<std::uint64_t> scan_number;
};

/// Writes while the observer is told that it takes its time: packing a large map is slow and says
/// nothing itself. A file that is being written when the user interrupts is finished first.
template <typename Written>
void write(const Written& surface, const std::string& file, const Observer& observer) {
  constexpr std::chrono::milliseconds kPeriod{200};
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  std::future<void> writing = std::async(std::launch::async, [&] { scan::write(surface, file); });
  while (writing.wait_for(kPeriod) != std::future_status::ready) {
    report_progress(observer, "write " + file, kUnknown);
  }
  writing.get();
}

int convert_scan(const Request& request, Context& context) {
  const Scan scan = read_scan(request.scan, context);
  results::Case doubts = doubts_of(scan);
  std::erase_if(doubts.warnings, [](const auto& one) { return one.code == "not-levelled"; });
  context.warn(results::findings_of({doubts}));
  write(scan.surface, request.output, context.observer());
  io::Json object = json_head(context, scan);
  object["output"] = request.output;
  object["nx"] = scan.surface.grid.nx;
  object["ny"] = scan.surface.grid.ny;
  object["missing_pixels"] = topography::count_holes(scan.surface);
  Facts facts;
  describe(scan, facts);
  facts.fact("written", request.output);
  const std::string note = context.spelled(scan::note_of(scan.surface, request.output));
  if (!note.empty()) {
    object["note"] = note;
    facts.fact("note", note);
  }
  return finish(context, object, facts.text());
}

/// The options of a scan that are in force.
std::vector<std::string> scan_flags(const ScanRequest& request) {
  std::vector<std::string> flags;
  for (const std::string& step : request.treatment) {
    flags.push_back("--" + step.substr(0, step.find('=')));
  }
  for (const auto& one : scan::read_parameters()) {
    if (one.is_given(request.read)) flags.push_back(one.option());
  }
  return flags;
}

/// They mean nothing for the maps of a result; defaults are meant for scans and do no harm.
void require_no_scan_options(const Request& request, const Context& context) {
  for (const std::string& flag : scan_flags(request.scan)) {
    const bool is_default = std::any_of(context.defaults.begin(), context.defaults.end(),
                                        [&](const auto& used) { return used.first == flag; });
    if (is_default) continue;
    throw UsageError("--field takes a map of a result as it is; leave out " + flag +
                     ", which belongs to scans");
  }
}

std::string state_text(const results::ResultMaps& result, std::optional<std::size_t> state) {
  const std::size_t n = result.states.size();
  if (n == 0) return "";
  if (!state) return fmt::format("all {}", n);
  return fmt::format("{} of {}: {}", *state, n, result.states[*state].label);
}

int convert_maps(const Request& request, Context& context) {
  require_no_scan_options(request, context);
  const results::ResultMaps result = study::read_maps(request.scan.file, request.scan_number);
  results::MapChoice choice = request.choice;
  choice.field = *request.field;
  const scan::MapSet maps = chosen_maps(result, choice);
  write(maps, request.output, context.observer());
  io::Json object = json_head(context);
  std::vector<std::string> names;
  for (const scan::NamedMap& map : maps.maps) names.push_back(map.name);
  object.update({{"result", result.file.string()},
                 {"output", request.output},
                 {"nx", maps.grid.nx},
                 {"ny", maps.grid.ny},
                 {"maps", names}});
  Facts facts;
  facts.fact("result", fmt::format("{}, {}", result.file.string(), pixels_text(maps.grid)));
  facts.fact("state", state_text(result, choice.state));
  facts.fact("maps", fmt::format("{}", fmt::join(names, ", ")));
  facts.fact("written", request.output);
  return finish(context, object, facts.text());
}

int convert(const Request& request, Context& context) {
  return request.field ? convert_maps(request, context) : convert_scan(request, context);
}

std::optional<std::size_t> parse_state(const std::string& text) {
  if (text == "all") return std::nullopt;
  const std::optional<double> number = parse_number(text);
  if (!number || *number < 0 || *number != std::floor(*number) || *number > 1e9) {
    throw UsageError(fmt::format("--state: got '{}'; expected 'all' or a number from 0", text));
  }
  return static_cast<std::size_t>(*number);
}

void declare_maps(OptionSet& set, Request& request) {
  constexpr const char* kField = "--field";
  set.group("Maps of a result");
  set.text(kField, "NAME|all",
           "write this map of a result: height, pressure, gap, film_thickness, displacement, "
           "contact (1 where solids touch), fluid_pressure, ... (.vti .gwy .csv hold any number "
           "of maps, .xyz .npy .txt one)",
           request.field);
  set.add({.flag = "--state",
           .placeholder = "N|all",
           .help = "number of the state in the result, from 0 [0]",
           .only_with = kField,
           .assign = [&choice = request.choice](const std::string& text) {
             choice.state = parse_state(text);
           }});
  set.count("--scan", "number of the scan in a study, from 0 [the only one]", request.scan_number)
      .only_with = kField;
}

std::vector<std::string> all_extensions() {
  std::vector<std::string> all = scan_extensions();
  for (const std::string& one : scan::map_extensions()) {
    if (std::find(all.begin(), all.end(), one) == all.end()) all.push_back(one);
  }
  return all;
}

}  // namespace

Verb convert_verb() {
  return {.name = "convert",
          .arguments = "SCAN OUT [options]",
          .summary = "write a scan, or maps of a result, in another format",
          .details =
              "The format follows the extension of OUT: .h5 .x3p .gwy .gsf .sdf .asdf .npy "
              ".sur .nc .zip (contact.engineering) .png .tif .txt .xyz .stl .vti. With --field the "
              "maps of a result are written instead, of contact, "
              "lubricate, "
              "friction, a study or ehl point: --field film_thickness.",
          .examples = {"tabor convert surfaces/edt_before.x3p edt.gwy",
                       "tabor convert surfaces/edt_before.x3p edt.h5 --level plane --lowpass "
                       "gauss:8um",
                       "tabor convert edt.h5 height.npy --field height"},
          .declare = [](OptionSet& set) -> Action {
            const auto request = std::make_shared<Request>();
            declare_scan(set, request->scan);
            declare_maps(set, *request);
            set.group("Output");
            Option& out = set.positional("OUT", "file to write", request->output);
            out.names = FileRole::output;
            out.extensions = all_extensions();
            return [request](Context& context) { return convert(*request, context); };
          }};
}

}  // namespace tabor::cli
