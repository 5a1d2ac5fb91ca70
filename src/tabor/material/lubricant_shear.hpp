#pragma once

#include <string_view>
#include <variant>

// Computes shear stress and effective viscosities of lubricants that thin or slip under shear.
namespace tabor::material {

/// Law of a stress proportional to the shear rate.
struct NewtonianShear {};

/// stress = tau_E asinh(eta rate / tau_E): Ree & Eyring 1955, doi:10.1063/1.1722098, with one
/// relaxing unit, as Johnson & Tevaarwerk 1977, doi:10.1098/rspa.1977.0129, without elasticity.
struct ReeEyringShear {
  double eyring_stress = 0;  ///< tau_E [Pa], > 0
};

/// stress = tau_L (1 - exp(-eta rate / tau_L)), tau_L = tau_0 + zeta max(p, 0): Bair & Winer 1979,
/// Journal of Lubrication Technology 101, 258, without elasticity. The stress stays below tau_L.
struct LimitingShear {
  double ambient_limit = 0;         ///< tau_0 [Pa], > 0
  double pressure_coefficient = 0;  ///< zeta [-], >= 0

  double limit_at(double pressure) const;  ///< tau_L [Pa]
};

/// One of the shear laws.
using Shear = std::variant<NewtonianShear, ReeEyringShear, LimitingShear>;

/// Throw InputError for stresses that are not positive or a negative coefficient.
ReeEyringShear ree_eyring_shear(double eyring_stress);
LimitingShear limiting_shear(double ambient_limit, double pressure_coefficient);

/// The shear laws by name.
enum class ShearLaw { newtonian, ree_eyring, limiting };

/// Returns the law of a name: "newtonian", "ree-eyring", "limiting". Throws InputError with the
/// nearest name.
ShearLaw parse_shear_law(std::string_view name);
std::string_view name(ShearLaw law);
ShearLaw law_of(const Shear& shear);

/// Effective viscosities of a thin sheared film against a small pressure gradient, with their
/// derivatives.
struct FlowViscosity {
  /// Viscosity along one direction of the film.
  struct Direction {
    double value = 0;         ///< [Pa s]
    double by_viscosity = 0;  ///< [-], at fixed rate and pressure
    double by_rate = 0;       ///< [Pa s^2], at fixed viscosity and pressure
    double by_pressure = 0;   ///< [s], at fixed viscosity and rate: the limit alone
  };
  Direction along;   ///< in the sliding direction: d(stress) / d(rate)
  Direction across;  ///< across it: stress / rate
};

/// Computes the effective viscosities where sliding dominates the shear of the film: the flow that
/// a pressure gradient adds meets the tangent of the flow curve along the sliding direction and its
/// secant across. For Ree & Eyring these are eta / cosh(tau_m / tau_E) and eta (tau_m / tau_E) /
/// sinh(tau_m / tau_E) with the mid-plane stress tau_m (Johnson & Tevaarwerk 1977). viscosity [Pa
/// s] > 0 at the node's pressure [Pa]; rate [1/s] = sliding speed / film thickness, of either sign;
/// 0 gives the viscosity itself.
FlowViscosity flow_viscosity(const Shear& shear, double viscosity, double rate, double pressure);

/// Mid-plane shear stress [Pa], of the sign of the rate, and its derivatives.
struct ShearStress {
  double value = 0;         ///< [Pa]
  double by_viscosity = 0;  ///< [1/s]
  double by_rate = 0;       ///< [Pa s]
  double by_pressure = 0;   ///< [-], at fixed viscosity and rate
};
ShearStress shear_stress(const Shear& shear, double viscosity, double rate, double pressure);

}  // namespace tabor::material
