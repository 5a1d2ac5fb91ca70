#include "tabor/cases/settings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "tabor/cases/parameters.hpp"
#include "tabor/core/units.hpp"
#include "tabor/material/library.hpp"
#include "tabor/material/solid.hpp"

namespace tabor::cases {
namespace {

std::optional<Objection> objection_to_pressure(double pressure, const ContactSettings& settings,
                                               const Spelling& spelling) {
  if (!bounds::above_zero.contain(pressure)) {
    return Objection{.setting = "mean_pressure",
                     .got = format_si(pressure, "Pa"),
                     .expected = bounds::above_zero.text};
  }
  if (pressure < settings.pressure_cap()) return std::nullopt;
  return Objection{
      .setting = "mean_pressure",
      .got = format_si(pressure, "Pa"),
      .expected = "less than the saturation pressure " + format_si(settings.pressure_cap(), "Pa"),
      .remedy = fmt::format("a contact that saturates there cannot carry this load; lower {} or "
                            "raise {}",
                            spelling("mean_pressure"), spelling("saturation_pressure"))};
}

/// The lists of CaseSettings of which one is given, in the order of its members.
constexpr std::array kControls{std::pair{"mean_pressure", &CaseSettings::mean_pressures},
                               std::pair{"separation", &CaseSettings::separations},
                               std::pair{"force", &CaseSettings::forces}};

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
    return objection_to_use(setting, spelling(setting) + " needs <fluid=reynolds>");
  }
  return std::nullopt;
}

}  // namespace

double ContactSettings::effective_modulus() const {
  const material::Solid solid{youngs_modulus, poissons_ratio};
  if (!counter_youngs_modulus) return material::effective_modulus(solid);
  return material::effective_modulus(solid,
                                     {*counter_youngs_modulus, counter_poissons_ratio.value_or(0)});
}

void ContactSettings::take_edges(const std::optional<topography::Edges>& edges) {
  if (!edges || boundary) return;
  boundary = *edges == topography::Edges::end ? Boundary::free : Boundary::periodic;
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
    return objection_to_use(
        "counter_youngs_modulus",
        fmt::format("{} and {} belong together; give both or none",
                    spelling("counter_youngs_modulus"), spelling("counter_poissons_ratio")));
  }
  if (auto found = objection_to_bounds(contact_parameters(), settings)) return found;
  if (auto found = objection(settings.tool, spelling)) return found;
  for (const double pressure : mean_pressures) {
    if (auto found = objection_to_pressure(pressure, settings, spelling)) return found;
  }
  return std::nullopt;
}

std::vector<contact::Control> controls_of(const CaseSettings& settings) {
  std::vector<contact::Control> controls;
  controls.reserve(settings.mean_pressures.size() + settings.separations.size() +
                   settings.forces.size());
  for (const double one : settings.mean_pressures) {
    controls.emplace_back(contact::MeanPressure{one});
  }
  for (const double one : settings.separations) controls.emplace_back(contact::Separation{one});
  for (const double one : settings.forces) controls.emplace_back(contact::Force{one});
  return controls;
}

std::optional<Objection> objection_to_controls(const CaseSettings& settings, bool boundary_is_known,
                                               const Spelling& spelling) {
  const auto n_given = std::count_if(kControls.begin(), kControls.end(), [&](const auto& one) {
    return !(settings.*one.second).empty();
  });
  if (n_given != 1) {
    return objection_to_use(
        "mean_pressure",
        fmt::format("give {} of {}, {} and {}", n_given == 0 ? "one" : "only one",
                    spelling("mean_pressure"), spelling("separation"), spelling("force")));
  }
  for (const double force : settings.forces) {
    if (bounds::above_zero.contain(force)) continue;
    return Objection{
        .setting = "force", .got = format_si(force, "N"), .expected = bounds::above_zero.text};
  }
  const bool repeats = settings.contact.is_periodic() &&
                       (boundary_is_known || settings.contact.boundary.has_value());
  if (settings.forces.empty() || !repeats) return std::nullopt;
  return objection_to_use(
      "force",
      fmt::format("{} needs a body that ends; use <boundary=free>, or {} for a surface that "
                  "repeats",
                  spelling("force"), spelling("mean_pressure")));
}

std::optional<Objection> objection(const ContactSettings& settings,
                                   const std::optional<topography::Edges>& edges) {
  if (!edges || !settings.boundary) return std::nullopt;
  const bool ends = *edges == topography::Edges::end;
  if (ends == (*settings.boundary == Boundary::free)) return std::nullopt;
  return objection_to_use(
      "edges", fmt::format("<edges={}> and <boundary={}> contradict each other; give one of them",
                           topography::kEdges.of(*edges), kBoundaries.of(*settings.boundary)));
}

std::optional<Objection> objection(const FilmSettings& settings) {
  return objection_to_bounds(film_parameters(), settings);
}

std::optional<Objection> objection(const FluidSettings& settings, const ContactSettings& contact,
                                   const Spelling& spelling) {
  if (!settings.flows()) return objection_to_idle(settings, spelling);
  if (!settings.sliding_speed) {
    return objection_to_use("sliding_speed",
                            fmt::format("<fluid=reynolds> needs {}, e.g. <sliding_speed=5mm/s>",
                                        spelling("sliding_speed")));
  }
  if (!settings.viscosity) {
    return objection_to_use("viscosity",
                            fmt::format("<fluid=reynolds> needs {}, e.g. <viscosity=0.225Pa*s>",
                                        spelling("viscosity")));
  }
  if (auto found = objection_to_bounds(fluid_parameters(), settings)) {
    if (found->setting == "sliding_speed") {
      found->remedy = "<flip=x> turns the scan to slide the other way";
    }
    return found;
  }
  friction::lubricant_of(settings.oil());
  if (contact.tool.is_rough()) {
    return objection_to_use("tool",
                            "<fluid=reynolds> needs a flat; leave out the rough tool, which would "
                            "change the gap as it slides");
  }
  if (contact.is_periodic()) return std::nullopt;
  return objection_to_use("boundary",
                          "<fluid=reynolds> needs a surface that repeats; use <edges=tile> or "
                          "<edges=cut>");
}

std::optional<Objection> objection_to_trapped(const CaseSettings& all, const Spelling& spelling) {
  const TrappedSettings& settings = all.trapped;
  if (auto found = objection_to_bounds(trapped_parameters(), settings)) return found;
  const std::string trapped = spelling("trapped");
  if (all.friction.dry_below > 0 && all.fluid.flows()) {
    return objection_to_use("dry_below",
                            fmt::format("{} applies to oil that does not flow; leave out {}",
                                        spelling("dry_below"), spelling("fluid")));
  }
  if (!settings.is_asked()) {
    if (settings.bulk_modulus == TrappedSettings::kOilBulkModulus) return std::nullopt;
    return objection_to_use("bulk_modulus",
                            fmt::format("{} needs {}", spelling("bulk_modulus"), trapped));
  }
  if (all.fluid.flows()) {
    return objection_to_use("trapped", fmt::format("oil is either trapped or flows; leave out {} "
                                                   "or {}",
                                                   trapped, spelling("fluid")));
  }
  if (all.contact.load_path) {
    return objection_to_use("trapped", fmt::format("{} needs the undeformed surface; leave out {}",
                                                   trapped, spelling("load_path")));
  }
  return std::nullopt;
}

std::optional<Objection> objection(const FrictionSettings& settings, const Spelling& spelling,
                                   std::string_view material) {
  const bool is_unknown = !material.empty() && !material::find_solid(material).shear_strength;
  if (settings.shear_strength == 0 && is_unknown) {
    return objection_to_use("shear_strength",
                            fmt::format("{} has no shear strength in the library; add {}", material,
                                        spelling("shear_strength")));
  }
  if (settings.boundary_shear_strength && settings.boundary_shear_share) {
    return objection_to_use(
        "boundary_shear_share",
        fmt::format("{} and {} say the same; give one of them", spelling("boundary_shear_strength"),
                    spelling("boundary_shear_share")));
  }
  if (auto found = objection_to_bounds(friction_parameters(), settings)) return found;
  const double boundary = settings.boundary_strength();
  if (boundary <= settings.shear_strength) return std::nullopt;
  return Objection{
      .setting = "boundary_shear_strength",
      .got = format_si(boundary, "Pa"),
      .expected = "zero to the shear strength, " + format_si(settings.shear_strength, "Pa")};
}

}  // namespace tabor::cases
