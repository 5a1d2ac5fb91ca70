#include "tabor/material/lubricant_mixture.hpp"

#include <fmt/core.h>

#include <cmath>

#include "tabor/core/error.hpp"
#include "tabor/material/lubricant_law.hpp"

namespace tabor::material {
namespace {

// Cheng 2008, eqs. 21 and 22, in Pa s; T in degrees Celsius.
double water_viscosity(double T) {
  return 1.790e-3 * std::exp((-1230 - T) * T / (36100 + 360 * T));
}
double glycerol_viscosity(double T) { return 12.100 * std::exp((-1233 + T) * T / (9900 + 70 * T)); }

/// Weight of the logarithm of water in the mixture, C the mass fraction of glycerol.
double weight_of_water(double C, double T, double c) {
  const double a = 0.705 - c * T;
  const double b = (4.9 + 0.036 * T) * std::pow(a, 2.5);
  return 1 - C + a * b * C * (1 - C) / (a * C + b * (1 - C));
}

}  // namespace

double glycerol_water_viscosity(double glycerol_mass_fraction, double kelvin,
                                GlycerolWaterFit fit) {
  const double C = glycerol_mass_fraction;
  const double T = kelvin - kZeroCelsius;
  if (!(C >= 0 && C <= 1)) {
    throw InputError("mass fraction of glycerol", fmt::format("{}", C), "0 to 1",
                     "95 % is written 0.95");
  }
  if (!(T >= 0 && T <= 100)) {
    throw InputError("temperature of the glycerol-water mixture", fmt::format("{} K", kelvin),
                     "273.15 K to 373.15 K, where the formula was fitted", "");
  }
  const double weight = weight_of_water(C, T, fit == GlycerolWaterFit::cheng ? 0.0017 : 0.0012);
  return std::exp(weight * std::log(water_viscosity(T)) +
                  (1 - weight) * std::log(glycerol_viscosity(T)));
}

}  // namespace tabor::material
