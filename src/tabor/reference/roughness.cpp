#include "tabor/reference/roughness.hpp"

#include <cmath>
#include <numbers>

namespace tabor::reference {

double persson_area_fraction(double reduced_pressure) {
  return std::erf(std::numbers::sqrt2 * reduced_pressure);
}

double saturated_friction(double shear_strength, double saturation_pressure) {
  return shear_strength / saturation_pressure;
}

double elastic_friction(double shear_strength, double effective_modulus, double rms_slope,
                        double kappa) {
  return kappa * shear_strength / (effective_modulus * rms_slope);
}

}  // namespace tabor::reference
