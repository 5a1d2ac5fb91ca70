#pragma once

#include "tabor/ehl/point/point.hpp"

namespace tabor::test {

/// The steel ball on steel of Redlich, Bartel & Deters 2003, Table 1: its groups W = 3.188e-5, U =
/// 2.16e-11, G = 4918 at 0.1 m/s, in the size that fits the paper's figures (R = 1.5 mm). The
/// surface of the disc stands still and is the rough one: u_m is half the ball's speed.
inline ehl::PointProblem redlich_case(double ball_speed, Index nodes) {
  ehl::PointProblem problem;
  problem.radius_x = 1.5e-3;
  problem.radius_y = 1.5e-3;
  problem.effective_modulus = 230.8e9 / 2;
  problem.load = 3.188e-5 * 230.8e9 * 1.5e-3 * 1.5e-3;
  problem.entrainment_speed = ball_speed / 2;
  problem.sliding_speed = ball_speed;
  const double pressure_coefficient = 4918 / 230.8e9;
  const double viscosity = 2.16e-11 * 230.8e9 * 1.5e-3 / 0.05;
  problem.lubricant = {
      .viscosity = material::roelands_viscosity(viscosity, pressure_coefficient),
      .density = material::relative_density(material::DensityLaw::dowson_higginson),
      .shear = material::ree_eyring_shear(6.8e6)};
  problem.plastic_pressure = 4e9;
  problem.nodes_x = nodes;
  problem.nodes_y = nodes;
  return problem;
}

/// The same with a domain that holds the dry contact and little more, for solve_point_dry().
inline ehl::PointProblem redlich_dry(Index nodes) {
  ehl::PointProblem problem = redlich_case(0.1, nodes);
  problem.inlet = problem.outlet = problem.half_width = 1.5;
  return problem;
}

}  // namespace tabor::test
