#include "tabor/reference/impact.hpp"

#include <cassert>
#include <cmath>
#include <numbers>

#include "tabor/reference/hertz.hpp"

namespace tabor::reference {

DryImpact hertz_impact(double sphere_radius, double effective_modulus, double mass, double speed) {
  assert(sphere_radius > 0 && effective_modulus > 0 && mass > 0 && speed > 0);
  const double approach = std::pow(
      15 * mass * speed * speed / (16 * std::sqrt(sphere_radius) * effective_modulus), 0.4);
  const HertzContact deepest = hertz_at_approach(sphere_radius, effective_modulus, approach);
  // 2 integral of dx / sqrt(1 - x^(5/2)) over 0 .. 1 = (4/5) B(2/5, 1/2).
  const double factor = 0.8 * std::tgamma(0.4) * std::sqrt(std::numbers::pi) / std::tgamma(0.9);
  return {.sphere_radius = sphere_radius,
          .effective_modulus = effective_modulus,
          .mass = mass,
          .speed = speed,
          .max_approach = approach,
          .max_force = deepest.load,
          .max_radius = deepest.radius,
          .max_pressure = deepest.max_pressure,
          .contact_time = factor * approach / speed};
}

double DryImpact::approach_at(double time) const {
  return time > 0 && time < contact_time
             ? max_approach * std::sin(std::numbers::pi * time / contact_time)
             : 0;
}

double DryImpact::force_at(double time) const {
  return hertz_at_approach(sphere_radius, effective_modulus, approach_at(time)).load;
}

}  // namespace tabor::reference
