#include <fmt/format.h>

#include <memory>
#include <optional>

#include "tabor/cli/contact_request.hpp"
#include "tabor/cli/density_curve.hpp"
#include "tabor/cli/verbs.hpp"
#include "tabor/core/error.hpp"
#include "tabor/study/curves_file.hpp"
#include "tabor/study/resolution_scan.hpp"
#include "tabor/study/scan_friction.hpp"

namespace tabor::cli {

namespace {

struct Request {
  ScanRequest scan;
  analysis::CaseSettings settings;
  FieldsRequest file;
  bool density_curve = false;
  bool resolution_scan = false;
};

void check_all(const analysis::CaseSettings& settings) {
  check_contact(settings);
  check(analysis::objection(settings.film));
  check(analysis::objection(settings.fluid, settings.contact, flag_of));
  check(analysis::objection(settings.friction, flag_of));
}

/// All that is printed, and the exit code so far.
struct Solved {
  std::vector<analysis::FrictionRecord> records;
  std::vector<analysis::DensityCurve> curves;
  std::vector<study::ResolutionRecord> resolution;
  int code = kDone;
};

Solved solve_all(const Request& request, const topography::Topography& surface,
                 analysis::FieldsFile* file, Context& context) {
  Solved solved;
  const auto receive = [&](const study::FrictionState& state) {
    solved.records.push_back(state.friction);
    if (file == nullptr) return;
    file->add_state(
        solved.records.size() - 1,
        cells_of(analysis::friction_columns(), state.friction, analysis::media::kObject),
        analysis::fields_of(state.contact, state.film, state.fluid));
  };
  study::RunOptions options;
  options.observer = context.observer();
  const auto maps = file != nullptr ? study::ContactMaps::kept : study::ContactMaps::dropped;
  solved.code = until_interrupted(context, [&] {
    solved.curves =
        study::friction_of(surface, request.settings, receive, maps, options).density_curves;
    if (!request.resolution_scan) return;
    solved.resolution = study::resolution_scan(surface, request.settings, solved.records, options);
  });
  for (const analysis::FrictionRecord& record : solved.records) {
    if (solved.code == kDone && !record.converged) solved.code = kNotConverged;
  }
  return solved;
}

/// The curve of the first pressure, and of all where there are several.
void add_curves(const std::vector<analysis::DensityCurve>& curves, io::Json& object) {
  if (curves.empty()) return;
  object["density_curve"] = json_of(curves.front());
  if (curves.size() == 1) return;
  io::Json all = io::Json::array();
  for (const analysis::DensityCurve& curve : curves) all.push_back(json_of(curve));
  object["density_curves"] = all;
}

/// What each curve says, and with --density-curve the curves.
std::string curves_text(const std::vector<analysis::DensityCurve>& curves, const Request& request) {
  if (curves.empty()) return "";
  Facts facts;
  std::string tables;
  for (const analysis::DensityCurve& curve : curves) {
    describe(curve, request.settings.film.lubricant_densities, "", facts);
    if (!request.density_curve) continue;
    Table table({"density at " + si(curve.mean_pressure, "Pa"), "wet share", "friction wet"});
    for (std::size_t i = 0; i < curve.lubricant_densities.size(); ++i) {
      table.row({analysis::density_text(curve.lubricant_densities[i]),
                 percent(curve.lubricated_shares[i]), plain(curve.friction_lubricated[i], 4)});
    }
    tables += '\n' + table.text();
  }
  return '\n' + facts.text() + tables;
}

std::string text_of(const Scan& scan, const Request& request, const Solved& solved) {
  const analysis::CaseSettings& settings = request.settings;
  Facts facts;
  describe(scan, facts);
  describe(settings.contact, facts);
  describe(settings.film, facts);
  describe(settings.fluid, facts);
  const double boundary = settings.friction.boundary_strength();
  facts.fact("friction",
             fmt::format("shear strength {}{}, contact area {}",
                         si(settings.friction.shear_strength, "Pa"),
                         boundary > 0 ? fmt::format(", of wet contact {}", si(boundary, "Pa")) : "",
                         friction::kAreas.of(settings.friction.area_of(settings.contact))));
  std::string text = facts.text() + '\n';
  text += table_of(analysis::friction_columns(), solved.records).text();
  text += curves_text(solved.curves, request);
  if (!request.resolution_scan) return text;
  return text + '\n' + table_of(study::resolution_columns(), solved.resolution).text();
}

int show(Request request, Context& context) {
  request.settings.film.seed = context.seed_or_default();
  check_all(request.settings);
  const Scan scan = read_scan(request.scan, context);
  require_no_holes(scan);
  const io::Json settings = analysis::settings_json(request.settings);
  auto file =
      fields_file(request.file, context, scan, settings, analysis::references_of(request.settings));
  const Solved solved = solve_all(request, scan.surface, file ? &*file : nullptr, context);
  if (solved.code == kInterrupted && solved.records.empty()) throw Interrupted();
  std::vector<analysis::Case> cases;
  cases.reserve(solved.records.size());
  for (const analysis::FrictionRecord& one : solved.records) cases.push_back(case_of(one));
  context.warn(analysis::findings_of(cases));
  if (file) {
    study::write_curves(solved.curves, request.scan.file, request.settings.film.lubricant_densities,
                        *file);
    file->commit(context.warnings);
  }
  io::Json object = json_head(context, scan);
  object.update(settings);
  object["states"] = states_json(analysis::friction_columns(), solved.records);
  add_curves(solved.curves, object);
  if (request.resolution_scan) {
    object["resolution"] = states_json(study::resolution_columns(), solved.resolution);
  }
  const auto columns = analysis::friction_columns(request.settings.fluid.flows());
  return finish(context, object,
                write_csv(request.file.csv, states_csv(columns, solved.records),
                          text_of(scan, request, solved)),
                solved.code);
}

}  // namespace

Verb friction_verb() {
  return {
      .name = "friction",
      .arguments =
          "SCAN --pressure P --youngs-modulus E --poisson-ratio NU --density D "
          "--shear-strength TAU [options]",
      .summary = "dry and lubricated Bowden-Tabor friction coefficients",
      .details =
          "Friction is the real contact area times the shear strength over the pressure; "
          "contact that stands in liquid carries no shear, or that of --boundary-shear-strength. "
          "'--density 0g/m^2' asks for dry friction alone. One sentence per pressure says from "
          "which density the pockets under the contacts are full and at which the valleys reach "
          "them. With --fluid reynolds the deposited oil flows while the flat slides: it carries "
          "part of the load and adds viscous shear.",
      .examples =
          {"tabor friction surfaces/edt_before.x3p --level plane --pressure 2MPa,7MPa "
           "--material aluminium-6016 --density 0.45g/m^2,0.9g/m^2",
           "tabor friction surfaces/edt_before.x3p --level plane --pressure 7MPa "
           "--youngs-modulus 70GPa --poisson-ratio 0.33 --saturation-pressure 240MPa "
           "--density 0.9g/m^2 --model bottom-fill --shear-strength 70MPa --area pixels "
           "--json",
           "tabor friction surfaces/edt_before.x3p --level plane --crop 96,96,128,128 --mirror "
           "--pressure 2MPa --youngs-modulus 70GPa --poisson-ratio 0.33 "
           "--saturation-pressure 240MPa --density 0.9g/m^2 --shear-strength 70MPa "
           "--fluid reynolds --speed 5mm/s --viscosity 0.225Pa*s"},
      .declare = [](OptionSet& set) -> Action {
        const auto request = std::make_shared<Request>();
        declare_scan(set, request->scan);
        analysis::CaseSettings& settings = request->settings;
        declare_contact(set, settings);
        declare_film(set, settings.film);
        declare_fluid(set, settings.fluid);
        declare_friction(set, settings.friction);
        set.toggle("--resolution-scan",
                   "repeat with pixels twice and four times as large and behind low-passes: how "
                   "far wet share and friction depend on the pixel",
                   request->resolution_scan);
        set.toggle("--density-curve", "print friction against the density of the oil",
                   request->density_curve);
        declare_fields(set, request->file);
        return [request](Context& context) { return show(*request, context); };
      }};
}

}  // namespace tabor::cli
