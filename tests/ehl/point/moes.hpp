#pragma once

#include <cmath>

#include "tabor/ehl/point/point.hpp"

namespace tabor::test {

/// A steel ball of 10 mm on steel with Moes' groups M and L and alpha = 2.2e-8 1/Pa; Roelands with
/// z = 0.6, or a constant viscosity if L = 0; incompressible.
inline ehl::PointProblem moes_case(double M, double L, Index nodes) {
  constexpr double kAlpha = 2.2e-8;
  constexpr double kReducedModulus = 2.26e11;  // E' = 2 E*
  constexpr double kIsoviscousSpeed = 1e-11;   // 2 U where L says nothing
  ehl::PointProblem problem;
  problem.radius_x = problem.radius_y = 0.01;
  problem.effective_modulus = kReducedModulus / 2;
  const double twice_speed_group =
      L > 0 ? std::pow(L / (kAlpha * kReducedModulus), 4) : kIsoviscousSpeed;
  const double viscosity = std::exp(kAlpha / (5.1e-9 * 0.6) - 9.67);
  problem.load = M * std::pow(twice_speed_group, 0.75) * kReducedModulus * 1e-4;
  problem.entrainment_speed = twice_speed_group / 2 * kReducedModulus * 0.01 / viscosity;
  if (L > 0) {
    problem.lubricant.viscosity = material::roelands_viscosity(viscosity, kAlpha);
  } else {
    problem.lubricant.viscosity = material::ConstantViscosity{viscosity};
  }
  problem.nodes_x = problem.nodes_y = nodes;
  return problem;
}

inline ehl::PointProblem compressible(ehl::PointProblem problem) {
  problem.lubricant.density = material::relative_density(material::DensityLaw::dowson_higginson);
  return problem;
}

/// Film in units of a^2 / Rx, as papers on point contacts give it.
inline double film_unit(const ehl::PointProblem& problem) {
  const double half_axis = ehl::hertz_of(problem).half_axis_x;
  return half_axis * half_axis / problem.radius_x;
}

/// Value at (0, 0) of a field by straight lines between the nodes.
inline double value_at_centre(const ehl::PointProblem& problem, const Field& field) {
  const double place =
      problem.inlet / (problem.inlet + problem.outlet) * static_cast<double>(problem.nodes_x - 1);
  const auto i = static_cast<Index>(place);
  const Index j = (problem.nodes_y - 1) / 2;
  const double share = place - static_cast<double>(i);
  return share > 0 ? (1 - share) * field(j, i) + share * field(j, i + 1) : field(j, i);
}

/// Film at (0, 0) [m].
inline double film_at_centre(const ehl::PointProblem& problem, const ehl::PointResult& result) {
  return value_at_centre(problem, result.film);
}

}  // namespace tabor::test
