#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string_view>

#include "tabor/cli/contact_request.hpp"
#include "tabor/cli/density_curve.hpp"
#include "tabor/cli/verbs.hpp"
#include "tabor/core/error.hpp"
#include "tabor/core/resources.hpp"
#include "tabor/core/units.hpp"
#include "tabor/study/curves_file.hpp"
#include "tabor/study/friction_graph.hpp"
#include "tabor/study/friction_table.hpp"
#include "tabor/study/resolution_scan.hpp"
#include "tabor/study/scan_friction.hpp"

namespace tabor::cli {

namespace {

struct Request {
  ScanRequest scan;
  cases::CaseSettings settings;
  FieldsRequest file;
  bool density_curve = false;
  bool resolution_scan = false;
};

void check_all(const cases::CaseSettings& settings) {
  check_contact(settings);
  check(cases::objection(settings.film));
  check(cases::objection_to_trapped(settings, flag_of));
  check(cases::objection(settings.fluid, settings.contact, flag_of));
  check(cases::objection(settings.friction, flag_of, settings.contact.material));
}

/// All that is printed, and the exit code so far.
struct Solved {
  std::vector<cases::FrictionRecord> records;
  std::vector<cases::DensityCurve> curves;
  study::CoarsePixels coarse;
  std::vector<study::ResolutionRecord> resolution;
  std::map<std::string, double, std::less<>> seconds;  ///< wall time by kind of work
  int code = kDone;
};

/// One part of the run in the JSON object and for a person.
struct TimedPart {
  std::string_view kind;  ///< of the jobs; those that are none are timed here
  const char* key;
  const char* words;
};
constexpr std::string_view kReading = "read", kResolution = "resolution", kAll = "all";
constexpr auto& kJobs = study::kFrictionJobs;
constexpr std::array kTimedParts{
    TimedPart{kReading, "reading", "reading"},
    TimedPart{kJobs.of(study::FrictionJob::film), "rain", "rain"},
    TimedPart{kJobs.of(study::FrictionJob::contact), "contacts", "contacts"},
    TimedPart{kJobs.of(study::FrictionJob::trapped), "trapped", "trapped oil"},
    TimedPart{kJobs.of(study::FrictionJob::fluid), "flow", "flow"},
    TimedPart{study::kCoarsePixels, "coarse_pixels", "coarse pixels"},
    TimedPart{kResolution, "resolution", "resolution scan"},
    TimedPart{study::kHandOn, "writing", "writing"}};

/// With --resolution-scan, a table says it.
bool compares(const Request& request) {
  const std::vector<double>& densities = request.settings.film.lubricant_densities;
  const bool has_oil =
      std::any_of(densities.begin(), densities.end(), [](double density) { return density > 0; });
  return has_oil && !request.settings.fluid.flows() && !request.resolution_scan &&
         request.settings.contact.tool.n_places() == 1;
}

Solved solve_all(const Request& request, const topography::Topography& surface,
                 results::FieldsFile* file, Context& context) {
  Solved solved;
  const auto receive = [&](const study::FrictionState& state) {
    solved.records.push_back(state.friction);
    if (file == nullptr) return;
    file->add(solved.records.size() - 1, state.friction, state.contact, state.oil);
  };
  engine::RunOptions options;
  options.observer = context.observer();
  const auto maps = file != nullptr ? study::ContactMaps::kept : study::ContactMaps::dropped;
  solved.code = until_interrupted(context, [&] {
    study::ScanFrictionResult result =
        study::friction_of(surface, request.settings, receive, maps, options, compares(request));
    solved.curves = std::move(result.density_curves);
    solved.coarse = std::move(result.coarse);
    solved.seconds.insert(result.seconds.begin(), result.seconds.end());
    if (!request.resolution_scan) return;
    const Stopwatch watch;
    solved.resolution = study::resolution_scan(surface, request.settings, solved.records, options);
    solved.seconds[std::string(kResolution)] = watch.seconds();
  });
  for (const cases::FrictionRecord& record : solved.records) {
    if (solved.code == kDone && !record.converged) solved.code = kNotConverged;
  }
  return solved;
}

/// One state with two pixels: that of the scan, and twice that.
struct PixelPair {
  const cases::FrictionRecord& state;
  double coarse_share;

  double change() const {
    const double larger = std::max(state.lubricated_share, coarse_share);
    return larger > 0 ? std::abs(state.lubricated_share - coarse_share) / larger : 0;
  }
};

/// Returns the pairs of the states that are there: the densities of the first pressure first.
std::vector<PixelPair> pixel_pairs(const Solved& solved) {
  std::vector<PixelPair> pairs;
  std::size_t i = 0;
  for (const std::vector<double>& of_pressure : solved.coarse.lubricated_shares) {
    for (const double share : of_pressure) {
      if (i < solved.records.size()) pairs.push_back({solved.records[i++], share});
    }
  }
  return pairs;
}

io::Json pixels_json(const Solved& solved, const Grid& grid) {
  io::Json list = io::Json::array();
  for (const PixelPair& pair : pixel_pairs(solved)) {
    list.push_back({{"mean_pressure_Pa", pair.state.mean_pressure},
                    {"lubricant_density_g_per_m2", in_g_per_m2(pair.state.lubricant_density)},
                    {"pixel_x_m", grid.dx()},
                    {"lubricated_share", io::number(pair.state.lubricated_share)},
                    {"coarse_pixel_x_m", solved.coarse.pixel_x},
                    {"coarse_lubricated_share", io::number(pair.coarse_share)}});
  }
  return list;
}

/// What the pixel does to the wet share where it does most, as a sentence.
void describe_pixels(const Solved& solved, const Grid& grid, Facts& facts) {
  const std::vector<PixelPair> pairs = pixel_pairs(solved);
  const auto most = std::max_element(
      pairs.begin(), pairs.end(),
      [](const PixelPair& a, const PixelPair& b) { return a.change() < b.change(); });
  if (most == pairs.end()) return;
  if (!(most->change() > 0)) {
    facts.fact("pixel", fmt::format("wet share the same with pixels of {} and of {}",
                                    si(grid.dx(), "m"), si(solved.coarse.pixel_x, "m")));
    return;
  }
  const std::string where =
      pairs.size() == 1
          ? ""
          : fmt::format(" ({} with {}, where it changes most)", si(most->state.mean_pressure, "Pa"),
                        results::density_text(most->state.lubricant_density));
  facts.fact("pixel",
             fmt::format("wet share {} with pixels of {}, {} with pixels of {}{}",
                         percent(most->state.lubricated_share), si(grid.dx(), "m"),
                         percent(most->coarse_share), si(solved.coarse.pixel_x, "m"), where));
}

/// What is printed of each state; at the end what a friction table would leave out.
Columns<cases::FrictionRecord> shown_columns() {
  Columns<cases::FrictionRecord> columns = cases::friction_columns();
  columns.push_back({"left_out", "", study::kLeftOutHeading, [](const cases::FrictionRecord& one) {
                       const std::string reason =
                           study::refusal_of(codes_of(one.warnings), one.converged);
                       return reason.empty() ? Cell() : Cell(reason);
                     }});
  return columns;
}

io::Json curve_json(const cases::DensityCurve& curve, const Solved& solved) {
  return json_of(curve, results::asked_at(curve.mean_pressure, solved.records));
}

/// The curve of the first pressure, and of all where there are several.
void add_curves(const Solved& solved, io::Json& object) {
  if (solved.curves.empty()) return;
  object["density_curve"] = curve_json(solved.curves.front(), solved);
  if (solved.curves.size() == 1) return;
  io::Json all = io::Json::array();
  for (const cases::DensityCurve& curve : solved.curves) all.push_back(curve_json(curve, solved));
  object["density_curves"] = all;
}

/// How far friction with droplets of finite size is from that with vanishing ones.
std::optional<results::LimitDifference> limit_difference(const Solved& solved,
                                                         const Request& request) {
  if (request.settings.film.model != deposition::Model::droplets) return std::nullopt;
  return results::difference_from_limit(solved.curves, solved.records);
}

void add_limit(const results::LimitDifference& most, io::Json& object) {
  object["limit_difference"] = {
      {"friction", most.friction},
      {"mean_pressure_Pa", most.mean_pressure},
      {"lubricant_density_g_per_m2", in_g_per_m2(most.lubricant_density)}};
}

void describe_limit(const results::LimitDifference& most, Facts& facts) {
  const std::string difference =
      most.friction > 0
          ? fmt::format("differs by at most {:.1g} ({} with {})", most.friction,
                        si(most.mean_pressure, "Pa"), results::density_text(most.lubricant_density))
          : "is the same";
  facts.fact("limit", "friction with vanishing droplets (--model limit, faster) " + difference);
}

/// What each curve says, and with --density-curve the curves.
std::string curves_text(const Solved& solved, const Request& request) {
  if (solved.curves.empty()) return "";
  Facts facts;
  std::string tables;
  for (const cases::DensityCurve& curve : solved.curves) {
    describe(curve, results::asked_at(curve.mean_pressure, solved.records), facts);
    if (!request.density_curve) continue;
    const bool is_limit = request.settings.film.model == deposition::Model::limit;
    Table table({"density at " + si(curve.mean_pressure, "Pa"),
                 is_limit ? "wet share" : "wet share of vanishing droplets", "friction wet"});
    for (std::size_t i = 0; i < curve.lubricant_densities.size(); ++i) {
      table.row({results::density_text(curve.lubricant_densities[i]),
                 percent(curve.lubricated_shares[i]), plain(curve.friction_lubricated[i], 4)});
    }
    tables += '\n' + table.text();
  }
  if (const auto most = limit_difference(solved, request)) describe_limit(*most, facts);
  return '\n' + facts.text() + tables;
}

double seconds_of(const Solved& solved, std::string_view kind) {
  const auto found = solved.seconds.find(kind);
  return found == solved.seconds.end() ? 0 : found->second;
}

io::Json seconds_json(const Solved& solved) {
  io::Json object;
  for (const TimedPart& part : kTimedParts) {
    if (solved.seconds.contains(part.kind)) object[part.key] = seconds_of(solved, part.kind);
  }
  object["all"] = seconds_of(solved, kAll);
  return object;
}

/// Where the time went, the longest part first.
std::string times_text(const Solved& solved) {
  constexpr double kWorthSaying = 0.1;  // [s]
  std::vector<std::pair<double, std::string>> parts;
  for (const TimedPart& part : kTimedParts) {
    const double seconds = seconds_of(solved, part.kind);
    if (seconds >= kWorthSaying) parts.emplace_back(seconds, part.words);
  }
  std::stable_sort(parts.begin(), parts.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  std::string text = fmt::format("{:.1f} s", seconds_of(solved, kAll));
  for (std::size_t i = 0; i < parts.size(); ++i) {
    text += fmt::format("{} {} {:.1f} s", i == 0 ? ":" : ",", parts[i].second, parts[i].first);
  }
  return text + (parts.size() > 1 ? " (side by side)" : "");
}

std::string text_of(const Scan& scan, const Request& request, const Solved& solved) {
  const cases::CaseSettings& settings = request.settings;
  Facts facts;
  describe(scan, facts);
  describe(settings.contact, facts);
  describe(settings.film, facts);
  describe(settings.trapped, facts);
  describe(settings.fluid, facts);
  const double boundary = settings.friction.boundary_strength();
  facts.fact(
      "friction",
      fmt::format("shear strength {}{}, on the {}", si(settings.friction.shear_strength, "Pa"),
                  boundary > 0 ? fmt::format(", of wet contact {}", si(boundary, "Pa")) : "",
                  friction::words_of(settings.friction.area_of(settings.contact))));
  std::string text = facts.text() + '\n';
  text += table_of(shown_columns(), solved.records).text();
  Facts pixels;
  describe_pixels(solved, scan.surface.grid, pixels);
  if (const std::string line = pixels.text(); !line.empty()) text += '\n' + line;
  text += curves_text(solved, request);
  if (request.resolution_scan) {
    text += '\n' + table_of(study::resolution_columns(), solved.resolution).text();
  }
  Facts time;
  time.fact("time", times_text(solved));
  return text + '\n' + time.text();
}

/// Rejects a curve that cannot be made and a table that would not be printed. A warning does not
/// advise the table that is.
void check_tables(const Request& request, Context& context) {
  std::vector<std::string> tables;
  if (request.density_curve) tables.emplace_back("--density-curve");
  if (request.resolution_scan) tables.emplace_back("--resolution-scan");
  if (request.file.csv.prints() && !context.json && !tables.empty()) {
    throw UsageError(fmt::format(
        "--csv prints the states alone, without the table of {}; name a file (--csv states.csv) to "
        "read both, or give --json",
        fmt::join(tables, " and ")));
  }
  if (request.density_curve && !cases::has_density_curve(request.settings)) {
    throw UsageError(
        "--density-curve needs --model droplets or limit, an oil density above zero and one place "
        "of the tool, without --trapped, --fluid and --dry-below");
  }
  if (!request.resolution_scan) return;
  context.spelling = [all = context.spelling](const Advice& advice) {
    return advice.setting == "resolution_scan" ? std::string() : all(advice);
  };
}

int show(Request request, Context& context) {
  request.settings.film.seed = context.seed_or_default();
  check_all(request.settings);
  check_tables(request, context);
  find_tool(request.settings.contact, context);
  const Stopwatch watch;
  const Scan scan = read_scan(request.scan, context);
  const double seconds_of_reading = watch.seconds();
  require_no_holes(scan);
  cases::ContactSettings& contact = request.settings.contact;  // a file may say its edges, too
  check(cases::objection(contact, scan.surface.edges));
  contact.take_edges(scan.surface.edges);
  check_all(request.settings);
  auto file = fields_file(request.file, context, scan, request.settings);
  Solved solved = solve_all(request, scan.surface, file ? &*file : nullptr, context);
  if (solved.code == kInterrupted && solved.records.empty()) throw Interrupted();
  std::vector<results::Case> cases;
  cases.reserve(solved.records.size());
  for (const cases::FrictionRecord& one : solved.records) cases.push_back(results::case_of(one));
  context.warn(results::findings_of(cases));
  if (file) {
    study::write_curves(solved.curves, request.scan.file, solved.records, *file);
    file->commit(context.warnings);
  }
  solved.seconds[std::string(kReading)] = seconds_of_reading;
  solved.seconds[std::string(kAll)] = watch.seconds();
  io::Json object = json_head(context, scan);
  object.update(results::settings_json(request.settings));
  object["states"] = states_json(cases::friction_columns(), solved.records);
  if (!solved.coarse.lubricated_shares.empty()) {
    object["pixel_dependence"] = pixels_json(solved, scan.surface.grid);
  }
  add_curves(solved, object);
  if (const auto most = limit_difference(solved, request)) add_limit(*most, object);
  if (request.resolution_scan) {
    object["resolution"] = states_json(study::resolution_columns(), solved.resolution);
  }
  object["seconds"] = seconds_json(solved);
  const auto columns = cases::friction_columns(cases::parts_of(request.settings));
  return finish(context, object,
                write_csv(request.file.csv, states_csv(columns, solved.records),
                          text_of(scan, request, solved)),
                solved.code);
}

}  // namespace

// NOLINTBEGIN(bugprone-suspicious-missing-comma): examples of several lines
Verb friction_verb() {
  return {
      .name = "friction",
      .arguments =
          "SCAN --pressure P --youngs-modulus E --poisson-ratio NU --density D "
          "--shear-strength TAU [options]",
      .summary = "compute dry and lubricated friction coefficients (Bowden-Tabor)",
      .details =
          "Friction is the real contact area times the shear strength, over the pressure. Wet "
          "contact has no shear strength unless you give --boundary-shear-strength. '--density "
          "0g/m^2' computes dry friction alone. One sentence per pressure says which density "
          "fills the pockets under the contacts and above which density the oil reaches the "
          "contacts. With --tool a rough tool replaces the flat. With --trapped the oil in closed "
          "pockets of the gap carries part of the load. With --fluid reynolds the oil flows while "
          "the flat slides, carries part of the load and adds viscous shear.",
      .examples =
          {"tabor friction surfaces/edt_before.x3p --level plane --pressure 2MPa,7MPa "
           "--material aluminium-6016 --density 0.45g/m^2,0.9g/m^2",
           "tabor friction surfaces/edt_before.x3p --level plane --pressure 7MPa "
           "--youngs-modulus 70GPa --poisson-ratio 0.33 --saturation-pressure 240MPa "
           "--density 0.9g/m^2 --model bottom-fill --shear-strength 70MPa --area pixels "
           "--json",
           "tabor friction surfaces/edt_before.x3p --level plane --pressure 2MPa,15MPa "
           "--material aluminium-6016 --density 0.9g/m^2 --tool ground:Sa=0.1um,length=1mm "
           "--tool-places 3",
           "tabor friction surfaces/edt_before.x3p --level plane --pressure 2MPa,15MPa "
           "--material aluminium-6016 --density 0.9g/m^2 --trapped "
           "--boundary-shear-strength 5MPa",
           "tabor friction surfaces/edt_before.x3p --level plane --crop 96,96,128,128 --mirror "
           "--pressure 2MPa --youngs-modulus 70GPa --poisson-ratio 0.33 "
           "--saturation-pressure 240MPa --density 0.9g/m^2 --shear-strength 70MPa "
           "--fluid reynolds --speed 5mm/s --viscosity 0.225Pa*s"},
      .declare = [](OptionSet& set) -> Action {
        const auto request = std::make_shared<Request>();
        declare_scan(set, request->scan);
        cases::CaseSettings& settings = request->settings;
        declare_contact(set, settings);
        declare_film(set, settings.film);
        declare_trapped(set, settings);
        declare_fluid(set, settings.fluid);
        declare_friction(set, settings.friction);
        set.toggle("--resolution-scan",
                   "repeat with pixels twice and four times as large and with low-passes, to show "
                   "how wet share and friction depend on the pixel",
                   request->resolution_scan);
        set.toggle(
            "--density-curve",
            "print friction against the density of the oil, in the limit of vanishing droplets",
            request->density_curve);
        declare_fields(set, request->file);
        return [request](Context& context) {
          take_edges(request->scan, request->settings.contact);
          return show(*request, context);
        };
      }};
}
// NOLINTEND(bugprone-suspicious-missing-comma)

}  // namespace tabor::cli
