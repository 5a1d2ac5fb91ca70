#include <fmt/format.h>

#include <memory>
#include <optional>

#include "tabor/cli/contact_request.hpp"
#include "tabor/cli/verbs.hpp"
#include "tabor/core/error.hpp"

namespace tabor::cli {

namespace {

struct Request {
  ScanRequest scan;
  ContactRequest contact;
  analysis::FilmSettings film;
  analysis::FluidSettings fluid;
  analysis::FrictionSettings friction;
  std::optional<std::string> output;
};

void check_all(const Request& request) {
  check(request.contact);
  check(analysis::objection(request.film));
  check(analysis::objection(request.fluid, request.contact.settings, flag_of));
  check(analysis::objection(request.friction));
}

io::Json all_settings(const Request& request) {
  io::Json settings = settings_json(request.contact.settings);
  settings.update(settings_json(request.film));
  settings.update(settings_json(request.fluid));
  settings["shear_strength_Pa"] = request.friction.shear_strength;
  settings["area"] = friction::kAreas.of(request.friction.area);
  return settings;
}

std::vector<std::string> all_references(const Request& request) {
  std::vector<std::string> all = analysis::references_of(request.contact.settings);
  const auto add = [&all](const std::vector<std::string>& more) {
    all.insert(all.end(), more.begin(), more.end());
  };
  add(analysis::references_of(request.film));
  add(analysis::references_of(request.friction));
  add(analysis::references_of(request.fluid));
  return all;
}

std::vector<StateField> maps_of(const analysis::ContactRecord& contact,
                                const analysis::FilmRecord& film,
                                const std::optional<analysis::FluidRecord>& fluid) {
  std::vector<StateField> fields = fields_of(contact);
  for (const StateField& field : fields_of(film)) fields.push_back(field);
  if (!fluid) return fields;
  for (const StateField& field : fields_of(*fluid)) fields.push_back(field);
  return fields;
}

std::string text_of(const Scan& scan, const Request& request, const Table& rows) {
  Facts facts;
  describe(scan, facts);
  describe(request.contact.settings, facts);
  describe(request.film, facts);
  describe(request.fluid, facts);
  facts.fact("friction", fmt::format("shear strength {}, {} contact area",
                                     si(request.friction.shear_strength, "Pa"),
                                     friction::kAreas.of(request.friction.area)));
  return facts.text() + '\n' + rows.text();
}

/// Every pressure with every density. Each density is rained once and each pressure solved once,
/// never once per combination.
int solve_all(const Request& request, const topography::Topography& surface,
              std::vector<analysis::FrictionRecord>& records, FieldsFile* file, Context& context) {
  const std::vector<analysis::FilmRecord> films =
      analysis::film_state(surface, request.film, context.observer());
  const analysis::ContactSettings& settings = request.contact.settings;
  const auto elasticity = analysis::make_operator(settings, surface.grid);
  const auto receive = [&](analysis::ContactRecord&& contact) {
    const Mask touching = contact.state.pressure > 0;
    for (const analysis::FilmRecord& film : films) {
      std::optional<analysis::FluidRecord> fluid;
      if (request.fluid.flows()) {
        fluid = analysis::fluid_state(*elasticity, surface.height, contact.state,
                                      contact.summary.mean_pressure, film.film.thickness, settings,
                                      request.fluid, context.observer());
      }
      records.push_back(
          analysis::friction_state(contact, {touching, contact.state.gap, surface.grid}, film,
                                   fluid ? &*fluid : nullptr, settings, request.friction));
      if (file == nullptr) continue;
      file->add_state(
          records.size() - 1,
          cells_of(analysis::friction_columns(), records.back(), analysis::media::kObject),
          maps_of(contact, film, fluid));
    }
  };
  return until_interrupted(context, [&] {
    analysis::contact_states(*elasticity, surface, settings, request.contact.pressures, receive,
                             context.observer());
  });
}

analysis::Case case_of(const analysis::FrictionRecord& record) {
  return {.pressure = si(record.mean_pressure, "Pa"),
          .density = density_text(record.lubricant_density),
          .warnings = record.warnings};
}

int show(Request request, Context& context) {
  request.film.seed = context.seed_or_default();
  check_all(request);
  const Scan scan = read_scan(request.scan, context);
  require_no_holes(scan);
  const io::Json settings = all_settings(request);
  std::optional<FieldsFile> file;
  if (request.output) {
    file.emplace(*request.output, context, scan, settings, all_references(request));
  }
  std::vector<analysis::FrictionRecord> records;
  int code = solve_all(request, scan.surface, records, file ? &*file : nullptr, context);
  if (code == kInterrupted && records.empty()) throw Interrupted();
  std::vector<analysis::Case> cases;
  for (const analysis::FrictionRecord& record : records) {
    cases.push_back(case_of(record));
    if (code == kDone && !record.converged) code = kNotConverged;
  }
  context.warn(analysis::findings_of(cases));
  if (file) file->commit(context);
  io::Json object = json_head(context, scan);
  object.update(settings);
  object["states"] = states_json(analysis::friction_columns(), records);
  return finish(context, object,
                text_of(scan, request, table_of(analysis::friction_columns(), records)), code);
}

}  // namespace

Verb friction_verb() {
  return {.name = "friction",
          .arguments =
              "SCAN --pressure P --youngs-modulus E --poisson-ratio NU --density D "
              "--shear-strength TAU [options]",
          .summary = "dry and lubricated Bowden-Tabor friction coefficients",
          .details =
              "Friction is the real contact area times the shear strength over the pressure; "
              "contact that stands in liquid carries no shear. '--density 0g/m^2' asks for "
              "dry friction alone. With --fluid reynolds the deposited oil flows while the flat "
              "slides: "
              "it carries part of the load and adds viscous shear.",
          .examples =
              {"tabor friction surfaces/edt_before.x3p --level plane --pressure 2MPa,7MPa "
               "--youngs-modulus 70GPa --poisson-ratio 0.33 --saturation-pressure 240MPa "
               "--density 0.45g/m^2,0.9g/m^2 --shear-strength 70MPa",
               "tabor friction surfaces/edt_before.x3p --level plane --pressure 7MPa "
               "--youngs-modulus 70GPa --poisson-ratio 0.33 --saturation-pressure 240MPa "
               "--density 0.9g/m^2 --model bottom-fill --shear-strength 70MPa --area pixels "
               "--json",
               "tabor friction surfaces/edt_before.x3p --level plane --crop 0,0,128,128 --mirror "
               "--pressure 2MPa --youngs-modulus 70GPa --poisson-ratio 0.33 "
               "--saturation-pressure 240MPa --density 0.9g/m^2 --shear-strength 70MPa "
               "--fluid reynolds --speed 5mm/s --viscosity 0.225Pa*s"},
          .declare = [](OptionSet& set) -> Action {
            const auto request = std::make_shared<Request>();
            declare_scan(set, request->scan);
            declare_contact(set, request->contact);
            declare_film(set, request->film);
            declare_fluid(set, request->fluid);
            declare_friction(set, request->friction);
            declare_output(set, request->output);
            return [request](Context& context) { return show(*request, context); };
          }};
}

}  // namespace tabor::cli
