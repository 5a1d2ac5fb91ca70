#include "tabor/cli/contact_request.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <string_view>

#include "tabor/cases/parameters.hpp"
#include "tabor/cli/exit_code.hpp"
#include "tabor/cli/parameter_options.hpp"
#include "tabor/core/error.hpp"
#include "tabor/core/units.hpp"
#include "tabor/material/library.hpp"

namespace tabor::cli {

namespace {

std::vector<std::string> names_of_materials() {
  std::vector<std::string> names;
  for (const material::NamedSolid& solid : material::solids()) names.push_back(solid.name);
  return names;
}

void declare_material(OptionSet& set, cases::CaseSettings& settings) {
  set.add(
      {.flag = kMaterial,
       .placeholder = "NAME",
       .help = "take E, NU and, where known, PS and TAU from the library ('tabor materials'); "
               "options override single values",
       .group = parameter_of(cases::contact_parameters(), "youngs_modulus").group,
       .words = names_of_materials(),
       .is_base = true,
       .assign = [&settings](const std::string& name) { cases::take_material(name, settings); }});
}

/// The options of these parameters, those left out that a verb declares itself or has elsewhere.
template <typename Settings>
void declare_all(OptionSet& set, const Parameters<Settings>& parameters, Settings& settings,
                 std::initializer_list<std::string_view> left_out = {}) {
  for (const Parameter<Settings>& one : parameters) {
    if (std::find(left_out.begin(), left_out.end(), one.name) == left_out.end()) {
      declare(set, one, settings).may_name_file = one.name == "tool";
    }
  }
}

/// A contact has one place of the tool; friction is averaged over several.
void declare_tool(OptionSet& set, cases::ToolSettings& settings, bool has_one_place) {
  if (has_one_place) return declare_all(set, cases::tool_parameters(), settings, {"tool_places"});
  declare_all(set, cases::tool_parameters(), settings);
}

}  // namespace

void declare_contact(OptionSet& set, cases::CaseSettings& settings, Controls controls) {
  Option& pressure =
      declare(set, parameter_of(cases::case_parameters(), "mean_pressure"), settings);
  if (controls == Controls::all) {
    pressure.required = false;
    for (const char* other : {"separation", "force"}) {
      declare(set, parameter_of(cases::case_parameters(), other), settings);
    }
  }
  declare_material(set, settings);
  declare_all(set, cases::contact_parameters(), settings.contact,
              {"load_path", "tool_places", "tool", "tool_x", "tool_lowpass", "tool_repeats"});
  declare_tool(set, settings.contact.tool, controls != Controls::pressures);
}

void declare_film(OptionSet& set, cases::FilmSettings& settings, bool is_needed) {
  const char* const density = "lubricant_density";
  Option& option = declare(set, parameter_of(cases::film_parameters(), density), settings);
  option.required = is_needed;
  declare_all(set, cases::film_parameters(), settings, {density, "seed"});  // all have --seed
}

void declare_dry_below(OptionSet& set, cases::FrictionSettings& settings) {
  declare(set, parameter_of(cases::friction_parameters(), "dry_below"), settings);
}

void declare_trapped(OptionSet& set, cases::CaseSettings& settings) {
  declare_all(set, cases::trapped_parameters(), settings.trapped);
  declare_dry_below(set, settings.friction);
}

void declare_fluid(OptionSet& set, cases::FluidSettings& settings) {
  declare_all(set, cases::fluid_parameters(), settings);
}

void declare_friction(OptionSet& set, cases::FrictionSettings& settings) {
  declare_all(set, cases::friction_parameters(), settings, {"dry_below"});  // among those of oil
}

void declare_fields(OptionSet& set, FieldsRequest& request) {
  declare_output(set, request.output);
  constexpr const char* file = "--output";
  set.choice("--fields", results::kFields,
             "maps to save in OUT; contact means heights, pressure and film [all]",
             request.options.fields)
      .only_with = file;
  set.toggle("--double", "save maps in double precision", request.options.doubles).only_with = file;
  declare_csv(set, "one row per state with the keys of --json", request.csv);
}

std::string flag_of(std::string_view setting) {
  if (const ParameterHead* found = cases::find_parameter(setting)) return found->option();
  return ParameterHead{.name = std::string(setting), .help = ""}.option();
}

void check(const std::optional<cases::Objection>& objection) {
  if (!objection) return;
  const bool has_value = !objection->got.empty();
  const InputError error(has_value ? flag_of(objection->setting) : "", objection->got,
                         objection->expected, objection->remedy);
  if (!objection->is_about_use) throw error;
  throw UsageError(has_value ? error.what() : objection->remedy);
}

void take_edges(const ScanRequest& scan, cases::ContactSettings& settings) {
  check(scan);
  const auto edges = topography::edges_of(scan.treatment);
  check(cases::objection(settings, edges));
  settings.take_edges(edges);
}

void find_tool(cases::ContactSettings& settings, Context& context) {
  if (settings.tool.is_scan()) context.files.reads(settings.tool.file());
  cases::find_tool(settings.tool, {});
}

void check_contact(const cases::CaseSettings& settings) {
  check(cases::objection(settings.contact, settings.mean_pressures, flag_of));
}

void describe(const cases::ContactSettings& settings, Facts& facts) {
  if (settings.load_path) {
    facts.fact("load path", "in the order given, plastic indentation is kept");
  }
  facts.fact("contact", fmt::format("{}E* {}, {}, {}, solver {}",
                                    settings.material.empty() ? "" : settings.material + ", ",
                                    si(settings.effective_modulus(), "Pa"),
                                    settings.saturation_pressure
                                        ? "saturation " + si(*settings.saturation_pressure, "Pa")
                                        : std::string("elastic"),
                                    cases::kBoundaries.of(settings.boundary_in_force()),
                                    cases::kSolvers.of(settings.solver)));
  describe(settings.tool, facts);
}

void describe(const cases::ToolSettings& settings, Facts& facts) {
  if (!settings.is_rough()) return;
  std::string text = *settings.tool;
  if (settings.tool_lowpass) text += ", lowpass " + *settings.tool_lowpass;
  text += settings.tool_places > 1
              ? fmt::format(", mean over {} places along x", settings.tool_places)
              : fmt::format(", at x = {}", si(settings.tool_x.value_or(0), "m"));
  facts.fact("tool", text);
}

void describe(const cases::FilmSettings& settings, Facts& facts) {
  std::string text(deposition::kModels.of(settings.model));
  if (settings.model == deposition::Model::droplets) {
    text += fmt::format(" of {}, {}, seed {}", si(settings.droplet_height, "m"),
                        deposition::kReadings.of(settings.reading), settings.seed);
  }
  const bool runs_down =
      settings.model == deposition::Model::droplets || settings.model == deposition::Model::limit;
  if (runs_down) text += fmt::format(", {} edge", deposition::kEdges.of(settings.edge));
  facts.fact("lubricant", fmt::format("{}, oil {} kg/m^3", text, plain(settings.oil_density)));
}

void describe(const cases::TrappedSettings& settings, Facts& facts) {
  if (!settings.is_asked()) return;
  facts.fact("trapped oil", std::isinf(settings.bulk_modulus)
                                ? "incompressible"
                                : "bulk modulus " + si(settings.bulk_modulus, "Pa"));
}

void describe(const cases::FluidSettings& settings, Facts& facts) {
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
    context.warn(fmt::format("Interrupted. Only the finished {} are shown", what));
    return kInterrupted;
  }
  return kDone;
}

}  // namespace tabor::cli
