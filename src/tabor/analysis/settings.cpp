#include "tabor/analysis/settings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "tabor/core/units.hpp"
#include "tabor/material/library.hpp"
#include "tabor/material/solid.hpp"

namespace tabor::analysis {
namespace {

constexpr double kFinestTolerance = 1e-12;
constexpr double kCoarsestTolerance = 1e-4;

std::optional<Objection> objection_to_pressure(double pressure, const ContactSettings& settings,
                                               const Spelling& spelling) {
  if (!(pressure > 0)) {
    return Objection{
        .setting = "mean_pressure", .got = format_si(pressure, "Pa"), .expected = "more than zero"};
  }
  if (pressure < settings.pressure_cap()) return std::nullopt;
  return Objection{
      .setting = "mean_pressure",
      .got = format_si(pressure, "Pa"),
      .expected = "less than the saturation pressure " + format_si(settings.pressure_cap(), "Pa"),
      .remedy = fmt::format("no contact that saturates there can carry this load; "
                            "lower {} or raise {}",
                            spelling("mean_pressure"), spelling("saturation_pressure"))};
}

/// Settings of a film that flows, where none does.
std::optional<Objection> objection_to_idle(const FluidSettings& settings,
                                           const Spelling& spelling) {
  const std::pair<const char*, bool> given[] = {
      {"sliding_speed", settings.sliding_speed.has_value()},
      {"viscosity", settings.viscosity.has_value()},
      {"pressure_viscosity", settings.pressure_viscosity.has_value()},
      {"eyring_stress", settings.eyring_stress.has_value()}};
  for (const auto& [setting, is_given] : given) {
    if (!is_given) continue;
    return Objection{.setting = setting,
                     .got = "",
                     .expected = "",
                     .remedy = fmt::format("{} belongs to a film that flows; add {} reynolds",
                                           spelling(setting), spelling("fluid")),
                     .is_about_use = true};
  }
  return std::nullopt;
}

Objection use(std::string setting, std::string remedy) {
  return {.setting = std::move(setting),
          .got = "",
          .expected = "",
          .remedy = std::move(remedy),
          .is_about_use = true};
}

}  // namespace

double ContactSettings::effective_modulus() const {
  const material::Solid solid{youngs_modulus, poissons_ratio};
  if (!counter_youngs_modulus) return material::effective_modulus(solid);
  return material::effective_modulus(solid,
                                     {*counter_youngs_modulus, counter_poissons_ratio.value_or(0)});
}

friction::FlowingOil FluidSettings::oil() const {
  return {viscosity.value_or(0), pressure_viscosity, eyring_stress};
}

void take_material(std::string_view name, CaseSettings& settings) {
  const material::NamedSolid& solid = material::find_solid(name);
  settings.contact.material = solid.name;
  settings.contact.youngs_modulus = solid.youngs_modulus.value;
  settings.contact.poissons_ratio = solid.poissons_ratio.value;
  if (solid.saturation_pressure) {
    settings.contact.saturation_pressure = solid.saturation_pressure->value;
  }
  if (solid.shear_strength) settings.friction.shear_strength = solid.shear_strength->value;
}

std::optional<Objection> objection(const ContactSettings& settings,
                                   const std::vector<double>& mean_pressures,
                                   const Spelling& spelling) {
  if (settings.counter_youngs_modulus.has_value() != settings.counter_poissons_ratio.has_value()) {
    return use("counter_youngs_modulus",
               fmt::format("{} and {} belong together; give both or none",
                           spelling("counter_youngs_modulus"), spelling("counter_poissons_ratio")));
  }
  if (!(settings.tolerance >= kFinestTolerance && settings.tolerance <= kCoarsestTolerance)) {
    return Objection{.setting = "tolerance",
                     .got = fmt::format("{}", settings.tolerance),
                     .expected = "1e-12 to 1e-4",
                     .is_about_use = true};
  }
  settings.effective_modulus();
  for (const double pressure : mean_pressures) {
    if (auto found = objection_to_pressure(pressure, settings, spelling)) return found;
  }
  return std::nullopt;
}

std::optional<Objection> objection(const FilmSettings& settings) {
  for (const double density : settings.lubricant_densities) {
    if (density >= 0) continue;
    return Objection{.setting = "lubricant_density",
                     .got = fmt::format("{:.4g} g/m^2", in_g_per_m2(density)),
                     .expected = "zero or more"};
  }
  if (!(settings.oil_density > 0)) {
    return Objection{.setting = "oil_density",
                     .got = fmt::format("{:.4g} kg/m^3", settings.oil_density),
                     .expected = "more than zero"};
  }
  if (!(settings.droplet_height > 0)) {
    return Objection{.setting = "droplet",
                     .got = format_si(settings.droplet_height, "m"),
                     .expected = "more than zero"};
  }
  return std::nullopt;
}

std::optional<Objection> objection(const FluidSettings& settings, const ContactSettings& contact,
                                   const Spelling& spelling) {
  if (!settings.flows()) return objection_to_idle(settings, spelling);
  const std::string asked = spelling("fluid") + " reynolds ";
  if (!settings.sliding_speed) {
    return use("sliding_speed",
               fmt::format("{0}needs {1}, e.g. {1} 5mm/s", asked, spelling("sliding_speed")));
  }
  if (!settings.viscosity) {
    return use("viscosity",
               fmt::format("{0}needs {1}, e.g. {1} 0.225Pa*s", asked, spelling("viscosity")));
  }
  if (*settings.sliding_speed < 0) {
    return Objection{.setting = "sliding_speed",
                     .got = format_si(*settings.sliding_speed, "m/s"),
                     .expected = "zero or more",
                     .remedy = "--mirror or --flip the scan to slide the other way"};
  }
  friction::lubricant_of(settings.oil());
  if (contact.is_periodic()) return std::nullopt;
  return use("boundary", fmt::format("{}is solved on a patch that repeats: use {} periodic", asked,
                                     spelling("boundary")));
}

std::optional<Objection> objection(const FrictionSettings& settings, const Spelling& spelling) {
  if (!(settings.shear_strength > 0)) {
    return Objection{.setting = "shear_strength",
                     .got = format_si(settings.shear_strength, "Pa"),
                     .expected = "more than zero",
                     .remedy = settings.shear_strength == 0
                                   ? fmt::format("give {}: of some materials the library does not "
                                                 "know it",
                                                 spelling("shear_strength"))
                                   : ""};
  }
  if (settings.boundary_shear_strength && settings.boundary_shear_share) {
    return use("boundary_shear_share",
               fmt::format("{} and {} say the same; give one of them",
                           spelling("boundary_shear_strength"), spelling("boundary_shear_share")));
  }
  const double share = settings.boundary_shear_share.value_or(0);
  if (!(share >= 0 && share <= 1)) {
    return Objection{.setting = "boundary_shear_share",
                     .got = fmt::format("{}", share),
                     .expected = "a share of the shear strength, 0 to 1"};
  }
  const double boundary = settings.boundary_strength();
  if (boundary >= 0 && boundary <= settings.shear_strength) return std::nullopt;
  return Objection{
      .setting = "boundary_shear_strength",
      .got = format_si(boundary, "Pa"),
      .expected = "zero to the shear strength, " + format_si(settings.shear_strength, "Pa")};
}

}  // namespace tabor::analysis
