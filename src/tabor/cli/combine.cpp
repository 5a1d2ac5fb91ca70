#include "tabor/comparison/combine.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <utility>

#include "tabor/cli/result.hpp"
#include "tabor/cli/table.hpp"
#include "tabor/cli/verbs.hpp"
#include "tabor/core/error.hpp"
#include "tabor/core/text.hpp"
#include "tabor/core/units.hpp"
#include "tabor/results/combination.hpp"

namespace tabor::cli {

namespace {

using comparison::Combination;
using comparison::CombineMode;
using comparison::Registration;
using comparison::Volume;
using comparison::WearVolumes;

struct Request {
  ScanRequest scan;
  std::string second;
  std::string mode = "wear";
  std::optional<std::string> match;
  bool no_register = false;
  std::vector<double> shift;  ///< [m], empty or x, y
  std::optional<double> threshold;
  std::optional<std::string> output;
};

/// The length whose cube and square all volumes and areas of a table are told in: tribologists know
/// mm^3 and µm^3 and no prefixes of m^3.
struct LengthUnit {
  std::string name;
  double length = 0;  ///< [m]

  std::string cubic(double volume) const {
    return fmt::format("{:.4g} {}^3", volume / (length * length * length), name);
  }
  std::string square(double area) const {
    return fmt::format("{:.4g} {}^2", area / (length * length), name);
  }
};

LengthUnit unit_for(const WearVolumes& wear) {
  constexpr double kMany = 1e6 * 1e-18;  // [m^3], a million um^3
  const bool is_large = std::max(wear.worn.value, wear.piled_up.value) >= kMany;
  return is_large ? LengthUnit{"mm", 1e-3} : LengthUnit{"µm", 1e-6};
}

std::vector<std::string> row_of(const std::string& name, const Volume& volume,
                                const LengthUnit& unit) {
  return {name, unit.cubic(volume.value), unit.cubic(volume.uncertainty), unit.square(volume.area)};
}

void describe(const Registration& r, Facts& facts) {
  facts.fact("shift of B",
             fmt::format("{} ± {} along x, {} ± {} along y", si(r.shift_x, "m"),
                         si(r.uncertainty_x, "m"), si(r.shift_y, "m"), si(r.uncertainty_y, "m")));
  facts.fact("match",
             fmt::format("correlation {:.4f} over {}; {:.1f} times its scatter at other shifts, "
                         "next best shift {:.0f} % of it",
                         r.correlation, percent(r.overlap), r.distinction, 100 * r.runner_up));
}

std::string text_of(const Request& request, const Scan& a, const Scan& b, const Combination& c) {
  Facts facts;
  describe(a, facts);
  describe(b, facts);
  facts.fact("mode", request.mode);
  if (c.registration) {
    describe(*c.registration, facts);
  } else {
    facts.fact("shift of B", fmt::format("{} along x, {} along y (not searched)",
                                         si(c.shift_x, "m"), si(c.shift_y, "m")));
  }
  const Grid& grid = c.map.grid;
  facts.fact("overlap", fmt::format("{}, {} common points", pixels_text(grid), c.n_common));
  facts.fact("Sq",
             fmt::format("A {}, B {}, {} {}", si(c.rms_a, "m"), si(c.rms_b, "m"),
                         request.mode == "composite" ? "A + B" : "A - B", si(c.rms_map, "m")));
  std::string text = facts.text();
  if (c.wear) {
    Table table({"volume", "value", "± (1 sigma)", "over"});
    const LengthUnit unit = unit_for(*c.wear);
    table.row(row_of("worn (A above B)", c.wear->worn, unit));
    table.row(row_of("piled up", c.wear->piled_up, unit));
    table.row(row_of("net, whole overlap", c.wear->net, unit));
    Facts noise;
    noise.fact("noise", fmt::format("{} rms, correlated over {:.3g} µm^2", si(c.wear->noise, "m"),
                                    c.wear->noise_area * 1e12));
    noise.fact("counted from", si(c.wear->threshold, "m") + " of the smoothed difference");
    noise.fact("noise floor",
               unit.cubic(c.wear->noise_floor) + " would be counted without any wear");
    text += '\n' + table.text() + '\n' + noise.text();
  }
  return text;
}

comparison::CombineOptions options_of(const Request& request) {
  if (!request.shift.empty() && request.shift.size() != 2) {
    throw UsageError("--shift: expected two lengths, e.g. 12um,-3.5um");
  }
  if (request.no_register && !request.shift.empty()) {
    throw UsageError("--no-register and --shift both place the second scan; give one of them");
  }
  if (request.mode == "composite") {
    for (const auto& [flag, is_given] : {std::pair{"--threshold", request.threshold.has_value()},
                                         std::pair{"--match", request.match.has_value()},
                                         std::pair{"--no-register", request.no_register}}) {
      if (!is_given) continue;
      throw UsageError(fmt::format(
          "{} needs --mode wear or difference: two faces are added as they are, centre on centre",
          flag));
    }
  }
  comparison::CombineOptions options;
  options.mode = *comparison::combine_mode_from(request.mode);
  if (request.match) options.level = *comparison::level_match_from(*request.match);
  options.search = !request.no_register;
  options.threshold = request.threshold.value_or(options.threshold);
  if (!request.shift.empty()) {
    options.shift_x = request.shift[0];
    options.shift_y = request.shift[1];
  }
  return options;
}

void write(const Combination& c, CombineMode mode, const std::string& file,
           const Context& context) {
  const std::string extension = lower(std::filesystem::path(file).extension().string());
  const std::vector<std::string>& results = hdf5_extensions();
  if (std::find(results.begin(), results.end(), extension) == results.end()) {
    return scan::write(c.map, file);
  }
  const auto methods = c.map.metadata.find("methods");
  const std::vector<std::string> keys =
      methods == c.map.metadata.end() ? std::vector<std::string>{} : split(methods->second, ' ');
  results::write_combination({c.map, std::string(comparison::name_of(mode)), results::values_of(c)},
                             head_of(context, "", keys), context.warnings, file);
}

int show(const Request& request, Context& context) {
  const auto options = options_of(request);
  ScanRequest second = request.scan;
  second.file = request.second;
  const Scan a = read_scan(request.scan, context);
  const Scan b = read_scan(second, context);
  std::vector<results::Case> cases = {doubts_of(a), doubts_of(b)};
  results::shorten_paths(cases);
  context.warn(results::findings_of(cases));
  const Combination c = comparison::combine(a.surface, b.surface, options, context.observer());
  for (const std::string& doubt : results::doubts_of(c)) context.warn(doubt);
  io::Json object = json_head(context, a);
  object["second_scan"] = {{"path", b.path}, {"sha256", b.sha256}};
  object["second_treatment_history"] = b.surface.history;
  object["mode"] = request.mode;
  object["level_match"] =
      options.mode == CombineMode::composite ? "none" : comparison::name_of(options.level);
  object.update(results::values_of(c));
  std::string text = text_of(request, a, b, c);
  if (request.output) {
    write(c, options.mode, *request.output, context);
    object["output"] = *request.output;
    text += "written " + *request.output + '\n';
  }
  return finish(context, object, text);
}

void declare_options(OptionSet& set, Request& request) {
  declare_scan(set, request.scan);
  set.group("Combination");
  set.input("SECOND", "scan after wear, or the other face", request.second);
  set.choice("--mode", {"wear", "difference", "composite"},
             "A - B with volumes (wear), A - B alone (difference), or two faces in contact, A + B "
             "turned over (composite) [wear]",
             request.mode);
  set.toggle("--no-register", "do not search a shift; put the scans corner on corner",
             request.no_register);
  set.quantities("--shift", "DX,DY",
                 "give the shift of B instead of searching it; a point at x in A is at x + DX in "
                 "B, e.g. --shift=-3um,1um",
                 dimension::length, request.shift);
  set.choice("--match", {"none", "offset", "plane"},
             "offset or tilt between the scans to remove, fitted where nothing changed [plane]",
             [&request](const std::string& word) { request.match = word; });
  set.number("--threshold", "SIGMAS",
             "smallest change that counts, in standard deviations of the noise [4]",
             request.threshold);
  set.group("Output");
  set.output("OUT", "save the map as a scan file, see 'tabor formats'", scan_extensions(),
             request.output);
}

}  // namespace

Verb combine_verb() {
  return {.name = "combine",
          .arguments = "SCAN SECOND [options]",
          .summary = "align two scans and subtract them (wear volume), or add two faces",
          .details =
              "Both scans are read and treated in the same way. The scans must have the same "
              "orientation, because rotation is not corrected.",
          .examples = {"tabor combine surfaces/edt_before.x3p surfaces/edt_before.x3p --level "
                       "plane --mode difference",
                       "tabor combine surfaces/edt_before.x3p surfaces/edt_after.x3p --level plane "
                       "--mode composite -o gap.gsf"},
          .declare = [](OptionSet& set) -> Action {
            const auto request = std::make_shared<Request>();
            declare_options(set, *request);
            return [request](Context& context) { return show(*request, context); };
          }};
}

}  // namespace tabor::cli
