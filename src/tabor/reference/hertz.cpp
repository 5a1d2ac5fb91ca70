#include "tabor/reference/hertz.hpp"

#include <cassert>
#include <cmath>
#include <numbers>

namespace tabor::reference {

HertzContact hertz_at_load(double sphere_radius, double effective_modulus, double load) {
  assert(sphere_radius > 0 && effective_modulus > 0 && load >= 0);
  const double a = std::cbrt(3 * load * sphere_radius / (4 * effective_modulus));
  return hertz_at_approach(sphere_radius, effective_modulus, a * a / sphere_radius);
}

HertzContact hertz_at_approach(double sphere_radius, double effective_modulus, double approach) {
  assert(sphere_radius > 0 && effective_modulus > 0 && approach >= 0);
  const double a = std::sqrt(approach * sphere_radius);
  return {.sphere_radius = sphere_radius,
          .effective_modulus = effective_modulus,
          .load = 4.0 / 3.0 * effective_modulus * a * approach,
          .radius = a,
          .approach = approach,
          .max_pressure = 2 * effective_modulus * a / (std::numbers::pi * sphere_radius)};
}

double hertz_pressure(const HertzContact& contact, double r) {
  const double ratio = r / contact.radius;
  return std::abs(r) < contact.radius ? contact.max_pressure * std::sqrt(1 - ratio * ratio) : 0;
}

double hertz_displacement(const HertzContact& contact, double r) {
  const double a = contact.radius;
  const double R = contact.sphere_radius;
  r = std::abs(r);
  if (r <= a) return contact.approach - r * r / (2 * R);
  return ((2 * a * a - r * r) * std::asin(a / r) + a * std::sqrt(r * r - a * a)) /
         (std::numbers::pi * R);
}

}  // namespace tabor::reference
