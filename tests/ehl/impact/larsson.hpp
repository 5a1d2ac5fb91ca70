#pragma once

#include "tabor/ehl/impact/impact.hpp"

namespace tabor::test {

/// The ball of Safa and Gohar as Larsson and Höglund compute it (first paper): a steel ball on
/// glass with a mineral oil, all equations from the start, a domain of 15 Hertz radii of the ball's
/// weight.
inline ehl::ImpactProblem safa_gohar(double domain_in_radii = 15) {
  ehl::ImpactProblem problem;
  problem.radius = 0.0127;
  problem.mass = 0.066;
  problem.speed = 0.313;
  problem.layer = 30e-6;
  problem.effective_modulus = 0.5 * 1.1e11;
  problem.gravity = 9.81;
  problem.lubricant.viscosity = material::roelands_viscosity(0.43, 2e-8);
  problem.lubricant.density = material::relative_density(material::DensityLaw::dowson_higginson);
  problem.start = ehl::ImpactStart::full;
  problem.domain_radius = domain_in_radii * 48.22e-6;
  problem.time_step = 0.5e-6;
  problem.nodes = 300;
  return problem;
}

/// The second paper's groups, with the R, E' and eta0 that all of its numbers follow from.
inline ehl::ImpactProblem from_groups(double layer, double speed, double mass, double material) {
  constexpr double kRadius = 0.01;
  constexpr double kModulus = 230e9;  // E' = 2 E*
  constexpr double kViscosity = 0.1;
  ehl::ImpactProblem problem;
  problem.radius = kRadius;
  problem.effective_modulus = kModulus / 2;
  problem.layer = layer * kRadius;
  problem.speed = speed * kModulus * kRadius / kViscosity;
  problem.mass = mass * kRadius * kViscosity * kViscosity / kModulus;
  problem.lubricant.viscosity = material::roelands_viscosity(kViscosity, material / kModulus);
  problem.lubricant.density = material::relative_density(material::DensityLaw::dowson_higginson);
  problem.nodes = 300;
  return problem;
}

}  // namespace tabor::test
