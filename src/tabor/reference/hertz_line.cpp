#include "tabor/reference/hertz_line.hpp"

#include <cassert>
#include <cmath>
#include <numbers>

namespace tabor::reference {

using std::numbers::pi;

HertzLineContact hertz_line_at_load(double radius, double effective_modulus, double load) {
  assert(radius > 0 && effective_modulus > 0 && load >= 0);
  const double b = std::sqrt(4 * load * radius / (pi * effective_modulus));
  return {.radius = radius,
          .effective_modulus = effective_modulus,
          .load = load,
          .half_width = b,
          .max_pressure = 0.5 * effective_modulus * b / radius};
}

double HertzLineContact::pressure(double x) const {
  const double q = x / half_width;
  return std::abs(x) < half_width ? max_pressure * std::sqrt(1 - q * q) : 0;
}

double HertzLineContact::gap(double x) const {
  const double q = std::abs(x) / half_width;
  return q > 1 ? half_width * half_width / (2 * radius) * (q * std::sqrt(q * q - 1) - std::acosh(q))
               : 0;
}

double HertzLineContact::displacement(double x, double datum) const {
  const double centre =
      load / (pi * effective_modulus) * (2 * std::log(2 * datum / half_width) + 1);
  return centre - x * x / (2 * radius) + gap(x);
}

double hertz_gap(double sphere_radius, double contact_radius, double r) {
  const double q = std::abs(r) / contact_radius;
  if (q <= 1) return 0;
  return contact_radius * contact_radius / (pi * sphere_radius) *
         (std::sqrt(q * q - 1) + (q * q - 2) * std::acos(1 / q));
}

}  // namespace tabor::reference
