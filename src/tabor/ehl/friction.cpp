#include "tabor/ehl/friction.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <optional>

#include "tabor/core/units.hpp"

namespace tabor::ehl {

namespace {

/// A warning where a Newtonian film is sheared at `stress` [Pa] under `pressure` [Pa].
std::optional<Warning> sheared_too_hard(const material::Shear& shear, double stress,
                                        double pressure, const std::string& remedy) {
  const bool is_newtonian = material::law_of(shear) == material::ShearLaw::newtonian;
  const double ratio = std::abs(stress) / pressure;
  if (!is_newtonian || !(ratio > kYieldRatio)) return std::nullopt;
  return Warning{
      "newtonian-shear",
      fmt::format("Newtonian shear would be {} times the pressure: no friction is given. {}",
                  plain(ratio, 2), remedy),
      ratio};
}

/// A warning where solids carry a share of the load and no law says how they rub.
std::optional<Warning> frictionless(const Asperities& asperities, double load_share) {
  if (!(load_share > 0) || asperities.has_friction()) return std::nullopt;
  return Warning{"boundary-friction",
                 fmt::format("Solids carry {} of the load and their friction is unknown. Give "
                             "asperities.friction_coefficient",
                             percent(load_share, 2)),
                 load_share};
}

}  // namespace

Warnings void_friction(const material::Shear& shear, const Asperities& asperities,
                       const FilmFriction& friction, const std::string& remedy) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  Warnings warnings;
  const auto stress =
      sheared_too_hard(shear, friction.max_shear_stress, friction.max_pressure, remedy);
  if (stress) {
    warnings.push_back(*stress);
    friction.fluid = friction.max_shear_stress = none;
  }
  const auto solids = frictionless(asperities, friction.solid_load_share);
  if (solids && std::isnan(friction.solid)) warnings.push_back(*solids);
  if (!warnings.empty()) friction.coefficient = friction.fluid + friction.solid;
  return warnings;
}

}  // namespace tabor::ehl
