#include <fmt/format.h>

#include <memory>
#include <optional>

#include "tabor/cli/contact_request.hpp"
#include "tabor/cli/fields_file.hpp"
#include "tabor/cli/film_request.hpp"
#include "tabor/cli/fluid_request.hpp"
#include "tabor/cli/verbs.hpp"
#include "tabor/core/error.hpp"
#include "tabor/friction/bowden_tabor.hpp"
#include "tabor/friction/trapped.hpp"
#include "tabor/friction/wet_contact.hpp"
#include "tabor/study/study.hpp"

namespace tabor::cli {

namespace {

struct Request {
  ScanRequest scan;
  ContactRequest contact;
  FilmRequest film;
  FluidRequest fluid;
  double shear_strength = 0;  ///< [Pa]
  std::string area = "corrected";
  std::optional<std::string> output;
};

std::vector<lubrication::Film> films_of(const Scan& scan, const Request& request,
                                        Context& context) {
  std::vector<lubrication::Film> films(request.film.densities.size());
  rain(scan, request.film, context,
       [&](std::size_t place, lubrication::Film&& film) { films[place] = std::move(film); });
  return films;
}

/// One pressure with one density.
struct State {
  io::Json json;
  analysis::Warnings warnings;
};

State state_of(const ContactResult& result, const lubrication::Film& film, double density,
               const Grid& grid, const Request& request) {
  const Mask touching = contact::contact_mask(result.state);
  const double wet_share = friction::lubricated_share(touching, film.thickness);
  const friction::TrappedLiquid trapped = friction::trapped_liquid(
      touching, film.thickness, result.state.gap, grid, request.contact.is_periodic());
  const double spilled = friction::spill_over_fraction(film.thickness, result.state.gap);
  const friction::Contact contact = for_friction(result, request.contact, wet_share);
  const friction::Estimate estimate =
      friction::estimate(contact, request.shear_strength, friction::parse_area(request.area));
  State state{.json = {}, .warnings = result.warnings};
  analysis::add(analysis::of_film(film), state.warnings);
  analysis::add(analysis::of_friction(contact, estimate, spilled), state.warnings);
  state.json = {{"mean_pressure_Pa", result.summary.mean_pressure},
                {"lubricant_density_g_per_m2", study::in_g_per_m2(density)},
                {"contact_area_fraction", result.summary.contact_area_fraction},
                {"contact_area_fraction_pixels", result.summary.contact_area_fraction_pixels},
                {"saturated_area_fraction", result.summary.saturated_area_fraction},
                {"mean_gap_m", result.summary.mean_gap},
                {"mean_film_m", film.mean_film},
                {"lubricated_share", wet_share},
                {"spill_over_fraction", spilled},
                {"trapped_fraction", trapped.trapped_fraction},
                {"area", friction::name(estimate.area)},
                {"friction_area_fraction", estimate.area_fraction},
                {"dry_at_bound", estimate.at_bound},
                {"friction_dry", estimate.friction_dry},
                {"friction_lubricated", estimate.friction_lubricated},
                {"certificate", io::number(result.state.convergence.certificate)},
                {"contact_gap_error_m", result.summary.contact_gap_error},
                {"converged", result.state.convergence.converged}};
  return state;
}

/// Adds what the oil does when it flows.
void add_fluid(const FluidResult& fluid, const Request& request, State& state) {
  const friction::MixedEstimate mixed =
      friction::estimate(fluid.summary, state.json.at("mean_pressure_Pa").get<double>(),
                         request.contact.saturation_pressure.value_or(contact::kNoSaturation),
                         request.shear_strength, friction::parse_area(request.area));
  state.json.update(fluid_json(fluid.summary, mixed));
  state.json["converged"] = state.json.at("converged").get<bool>() && fluid.summary.converged;
  analysis::add(analysis::of_flow(fluid.doubts, mixed), state.warnings);
}

std::vector<std::string> row_of(const io::Json& state) {
  const auto number = [&](const char* key) { return state.at(key).get<double>(); };
  std::vector<std::string> row = {
      si(number("mean_pressure_Pa"), "Pa"),
      plain(number("lubricant_density_g_per_m2")) + " g/m²",
      percent(number("friction_area_fraction")),
      percent(number("lubricated_share")),
      percent(number("spill_over_fraction")),
      plain(number("friction_dry")),
      plain(number("friction_lubricated")),
      state.at("certificate").is_null() ? "-" : fmt::format("{:.1e}", number("certificate")),
      yes_no(state.at("converged").get<bool>())};
  if (state.contains("fluid_load_share")) {
    row.insert(row.end() - 2, {percent(number("fluid_load_share")),
                               plain(number("friction_viscous")), plain(number("friction_mixed"))});
  }
  return row;
}

Table table(const Request& request) {
  std::vector<std::string> titles = {"pressure",     "lubricant",   "contact",
                                     "wet share",    "spill-over",  "friction dry",
                                     "friction wet", "certificate", "converged"};
  if (request.fluid.asked()) {
    titles.insert(titles.end() - 2, {"oil carries", "viscous", "friction mixed"});
  }
  return Table(titles);
}

io::Json all_settings(const Request& request, const Context& context) {
  io::Json settings = settings_json(request.contact);
  settings.update(settings_json(request.film, context));
  settings.update(settings_json(request.fluid));
  settings["shear_strength_Pa"] = request.shear_strength;
  settings["area"] = request.area;
  return settings;
}

std::vector<std::string> all_methods(const Request& request) {
  std::vector<std::string> methods = methods_of(request.contact);
  for (const std::string& method : methods_of(request.film)) methods.push_back(method);
  methods.emplace_back("bowden1950");
  for (const std::string& method : methods_of(request.fluid)) methods.push_back(method);
  return methods;
}

std::vector<StateField> maps_of(const contact::State& state, const lubrication::Film& film,
                                const std::optional<FluidResult>& fluid) {
  std::vector<StateField> fields = fields_of(state);
  fields.push_back({"film_thickness", "m", "thickness of the lubricant film", film.thickness});
  if (!fluid) return fields;
  for (const StateField& field : fields_of(fluid->state)) fields.push_back(field);
  return fields;
}

std::string text_of(const Scan& scan, const Request& request, const Context& context,
                    const Table& rows) {
  Facts facts;
  describe(scan, facts);
  describe(request.contact, facts);
  describe(request.film, context, facts);
  describe(request.fluid, facts);
  facts.fact("friction", fmt::format("shear strength {}, {} contact area",
                                     si(request.shear_strength, "Pa"), request.area));
  return facts.text() + '\n' + rows.text();
}

int show(const Request& request, Context& context) {
  check(request.contact);
  check(request.film);
  check(request.fluid, request.contact);
  if (request.shear_strength <= 0) {
    throw InputError("--shear-strength", si(request.shear_strength, "Pa"), "more than zero", "");
  }
  const Scan scan = read_scan(request.scan, context);
  require_no_holes(scan);
  const io::Json settings = all_settings(request, context);
  std::optional<FieldsFile> file;
  if (request.output) file.emplace(*request.output, context, scan, settings, all_methods(request));
  io::Json object = json_head(context, scan);
  object.update(settings);
  object["states"] = io::Json::array();

  // Each density is rained once and each pressure solved once, never once per combination.
  const std::vector<lubrication::Film> films = films_of(scan, request, context);
  const auto elasticity = make_operator(request.contact, scan.surface.grid);
  Table rows = table(request);
  std::vector<analysis::Case> cases;
  bool films_converged = true;
  const int code =
      solve_all(*elasticity, scan, request.contact, context, [&](const ContactResult& result) {
        for (std::size_t i = 0; i < films.size(); ++i) {
          State state =
              state_of(result, films[i], request.film.densities[i], scan.surface.grid, request);
          std::optional<FluidResult> fluid;
          if (request.fluid.asked()) {
            fluid = solve_fluid(*elasticity, scan.surface.height, result, films[i].thickness,
                                request.contact, request.fluid, context);
            add_fluid(*fluid, request, state);
            films_converged = films_converged && fluid->summary.converged;
          }
          state.json["warning_codes"] = analysis::codes_of(state.warnings);
          if (file) {
            file->add_state(object["states"].size(), state.json,
                            maps_of(result.state, films[i], fluid));
          }
          object["states"].push_back(state.json);
          rows.row(row_of(state.json));
          cases.push_back({.pressure = si(result.summary.mean_pressure, "Pa"),
                           .density = density_text(request.film.densities[i]),
                           .warnings = state.warnings});
        }
      });
  if (code == kInterrupted && object["states"].empty()) throw Interrupted();
  context.warn(analysis::findings_of(cases));
  if (file) file->commit(context);
  return finish(context, object, text_of(scan, request, context, rows),
                code == kDone && !films_converged ? kNotConverged : code);
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
            set.group("Friction");
            set.quantity("--shear-strength", "TAU", "shear strength of the contact, e.g. 70MPa",
                         dimension::pressure, request->shear_strength)
                .required = true;
            set.choice(
                "--area", {"corrected", "pixels"},
                "contact area that friction uses: perimeter-corrected or counted [corrected]",
                request->area);
            declare_output(set, request->output);
            return [request](Context& context) { return show(*request, context); };
          }};
}

}  // namespace tabor::cli
