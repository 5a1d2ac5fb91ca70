#include "tabor/ehl/friction.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <optional>

#include "tabor/core/units.hpp"

namespace tabor::ehl {

namespace {

/// A warning where a Newtonian film is sheared at `stress` [Pa] under `pressure` [Pa].
std::optional<std::string> sheared_too_hard(const material::Shear& shear, double stress,
                                            double pressure) {
  const bool is_newtonian = material::law_of(shear) == material::ShearLaw::newtonian;
  const double ratio = std::abs(stress) / pressure;
  if (!is_newtonian || !(ratio > kYieldRatio)) return std::nullopt;
  return fmt::format(
      "a Newtonian film would be sheared at {}, {} times the pressure; oils give way at a tenth of "
      "it: no friction of the film; give lubricant.eyring_stress (tabor ehl point), less viscosity "
      "or a lower sliding speed",
      si(stress, "Pa"), plain(ratio, 2));
}

/// A warning where solids carry a share of the load and no law says how they rub.
std::optional<std::string> frictionless(const Asperities& asperities, double load_share) {
  if (!(load_share > 0) || asperities.has_friction()) return std::nullopt;
  return fmt::format(
      "solids carry {} of the load and the case does not say how they rub, as if they were "
      "frictionless: no friction; give asperities.friction_coefficient (steel in oil: 0.1 to 0.15) "
      "or asperities.shear_strength",
      percent(load_share, 2));
}

}  // namespace

std::vector<std::string> void_friction(const material::Shear& shear, const Asperities& asperities,
                                       const FilmFriction& friction) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  std::vector<std::string> warnings;
  const auto stress = sheared_too_hard(shear, friction.max_shear_stress, friction.max_pressure);
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
