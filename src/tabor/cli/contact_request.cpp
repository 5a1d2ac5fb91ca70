#include "tabor/cli/contact_request.hpp"

#include <fmt/format.h>

#include <map>

#include "tabor/cli/exit_code.hpp"
#include "tabor/core/error.hpp"
#include "tabor/core/units.hpp"

namespace tabor::cli {

namespace {

const char* const kMaterial = "--material";

void declare_material(OptionSet& set, analysis::CaseSettings& settings) {
  set.add({.flag = kMaterial,
           .placeholder = "NAME",
           .help = "take E, NU and, where known, PS and TAU from the library ('tabor materials'); "
                   "options override them",
           .is_base = true,
           .assign = [&settings](const std::string& name) {
             analysis::take_material(name, settings);
           }});
}

void require_without_material(Option& option) {
  option.required = true;
  option.unless = kMaterial;
}

}  // namespace

void declare_contact(OptionSet& set, analysis::CaseSettings& settings) {
  set.group("Contact");
  set.quantities("--pressure", "P[,P2,...]", "mean pressure, load / nominal area, e.g. 2MPa,7MPa",
                 dimension::pressure, settings.mean_pressures)
      .required = true;
  declare_material(set, settings);
  require_without_material(set.quantity("--youngs-modulus", "E",
                                        "Young's modulus of the rough body, e.g. 70GPa",
                                        dimension::pressure, settings.contact.youngs_modulus));
  require_without_material(set.number("--poisson-ratio", "NU",
                                      "Poisson's ratio of the rough body, e.g. 0.33",
                                      settings.contact.poissons_ratio));
  set.quantity("--counter-youngs-modulus", "E2", "Young's modulus of the counter body [rigid]",
               dimension::pressure, settings.contact.counter_youngs_modulus);
  set.number("--counter-poisson-ratio", "NU2", "Poisson's ratio of the counter body",
             settings.contact.counter_poissons_ratio);
  set.add({.flag = "--saturation-pressure",
           .placeholder = "PS",
           .help = "cap on the contact pressure, e.g. 240MPa; none: elastic [none]",
           .unless = kMaterial,
           .assign = [&settings](const std::string& text) {
             settings.contact.saturation_pressure.reset();
             if (text == "none") return;
             settings.contact.saturation_pressure =
                 parse_si(text, dimension::pressure, "--saturation-pressure");
           }});
  set.choice("--boundary", analysis::kBoundaries,
             "periodic: the scan repeats; free: loaded on the scan only [periodic]",
             settings.contact.boundary);
  set.number("--tolerance", "T", "certificate to reach, 1e-12 to 1e-4 [1e-6]",
             settings.contact.tolerance);
  set.choice("--solver", analysis::kSolvers, "polonsky-keer is the textbook baseline [fast]",
             settings.contact.solver);
}

void declare_film(OptionSet& set, analysis::FilmSettings& settings) {
  set.group("Lubricant");
  set.quantities("--density", "D[,D2,...]", "areal lubricant density as dosed, e.g. 0.45g/m^2",
                 dimension::areal_density, settings.lubricant_densities)
      .required = true;
  set.quantity("--oil-density", "RHO", "density of the liquid [900kg/m^3]", dimension::density,
               settings.oil_density);
  set.quantity("--droplet", "D", "droplet volume / pixel area [0.1um]", dimension::length,
               settings.droplet_height);
  set.choice(
      "--model", deposition::kModels,
      "droplets run downhill; limit: vanishing droplets; one level; constant film [droplets]",
      settings.model);
  set.choice("--reading", deposition::kReadings,
             "what a full pit does with the rest of a droplet: pass it on or drop it [conserving]",
             settings.reading);
  set.choice("--edge", deposition::kEdges, "what the border of the scan is [closed]",
             settings.edge);
}

void declare_fluid(OptionSet& set, analysis::FluidSettings& settings) {
  set.group("Fluid film");
  set.choice("--fluid", analysis::kFluids,
             "reynolds: the deposited oil flows and carries part of the load [none]",
             settings.fluid);
  set.quantity("--speed", "U", "sliding speed along +x, e.g. 5mm/s", dimension::speed,
               settings.sliding_speed);
  set.quantity("--viscosity", "ETA", "dynamic viscosity of the oil, e.g. 0.225Pa*s",
               dimension::viscosity, settings.viscosity);
  set.quantity("--pressure-viscosity", "ALPHA",
               "its growth with pressure by Roelands' law, e.g. 2e-8/Pa [constant]",
               dimension::per_pressure, settings.pressure_viscosity);
  set.quantity("--eyring-stress", "TAU", "Ree-Eyring stress of the oil, e.g. 5MPa [Newtonian]",
               dimension::pressure, settings.eyring_stress);
}

void declare_friction(OptionSet& set, analysis::FrictionSettings& settings) {
  set.group("Friction");
  require_without_material(set.quantity("--shear-strength", "TAU",
                                        "shear strength of the contact, e.g. 70MPa",
                                        dimension::pressure, settings.shear_strength));
  set.quantity("--boundary-shear-strength", "TAU_B",
               "shear strength of wet contact, at most TAU, e.g. 5MPa [0]", dimension::pressure,
               settings.boundary_shear_strength);
  set.number("--boundary-shear-share", "X", "the same as a share of TAU, e.g. 0.1",
             settings.boundary_shear_share);
  set.choice("--area", friction::kAreas,
             "contact area that friction uses: perimeter-corrected or counted [pixels with a "
             "saturation pressure, else corrected]",
             settings.area);
}

void declare_fields(OptionSet& set, FieldsRequest& request) {
  declare_output(set, request.output);
  constexpr const char* file = "--output";
  set.choice("--fields", analysis::kFields,
             "maps in OUT: contact has heights, pressure and film [all]", request.options.fields)
      .only_with = file;
  set.toggle("--double", "keep maps in OUT in double precision", request.options.doubles)
      .only_with = file;
  declare_csv(set, "one row per state with the keys of --json", request.csv);
}

std::optional<analysis::FieldsFile> fields_file(const FieldsRequest& request,
                                                const Context& context, const Scan& scan,
                                                const io::Json& settings,
                                                const std::vector<std::string>& methods) {
  if (!request.output) return std::nullopt;
  return analysis::FieldsFile(*request.output, request.options,
                              head_of(context, analysis::toml_of(settings), methods), scan.surface,
                              {scan.path, scan.sha256});
}

std::string flag_of(std::string_view setting) {
  static const std::map<std::string_view, std::string_view> others = {
      {"mean_pressure", "pressure"},
      {"lubricant_density", "density"},
      {"sliding_speed", "speed"},
      {"counter_poissons_ratio", "counter-poisson-ratio"},
      {"poissons_ratio", "poisson-ratio"}};
  const auto found = others.find(setting);
  std::string flag = "--" + std::string(found == others.end() ? setting : found->second);
  for (char& c : flag) {
    if (c == '_') c = '-';
  }
  return flag;
}

void check(const std::optional<analysis::Objection>& objection) {
  if (!objection) return;
  const bool has_value = !objection->got.empty();
  const InputError error(has_value ? flag_of(objection->setting) : "", objection->got,
                         objection->expected, objection->remedy);
  if (!objection->is_about_use) throw error;
  throw UsageError(has_value ? error.what() : objection->remedy);
}

void check_contact(const analysis::CaseSettings& settings) {
  check(analysis::objection(settings.contact, settings.mean_pressures, flag_of));
}

void describe(const analysis::ContactSettings& settings, Facts& facts) {
  if (settings.load_path) {
    facts.fact("load path", "in the order given, plastic indentation is kept");
  }
  facts.fact("contact", fmt::format("{}E* {}, {}, {}, solver {}",
                                    settings.material.empty() ? "" : settings.material + ", ",
                                    si(settings.effective_modulus(), "Pa"),
                                    settings.saturation_pressure
                                        ? "saturation " + si(*settings.saturation_pressure, "Pa")
                                        : std::string("elastic"),
                                    analysis::kBoundaries.of(settings.boundary),
                                    analysis::kSolvers.of(settings.solver)));
}

void describe(const analysis::FilmSettings& settings, Facts& facts) {
  std::string text(deposition::kModels.of(settings.model));
  if (settings.model == deposition::Model::droplets) {
    text += fmt::format(" of {}, {}, seed {}", si(settings.droplet_height, "m"),
                        deposition::kReadings.of(settings.reading), settings.seed);
  }
  facts.fact("lubricant",
             fmt::format("{}, {} edge, oil {} kg/m^3", text, deposition::kEdges.of(settings.edge),
                         plain(settings.oil_density)));
}

void describe(const analysis::FluidSettings& settings, Facts& facts) {
  if (!settings.flows()) return;
  std::string text = fmt::format("sliding at {}, {}", si(*settings.sliding_speed, "m/s"),
                                 si(*settings.viscosity, "Pa s"));
  if (settings.pressure_viscosity) text += ", Roelands";
  if (settings.eyring_stress) text += ", Eyring stress " + si(*settings.eyring_stress, "Pa");
  facts.fact("fluid film", text);
}

int until_interrupted(Context& context, const std::function<void()>& make_states,
                      const std::string& what) {
  try {
    make_states();
  } catch (const Interrupted&) {
    context.warn(fmt::format("interrupted: only the {} that were finished are shown", what));
    return kInterrupted;
  }
  return kDone;
}

}  // namespace tabor::cli
