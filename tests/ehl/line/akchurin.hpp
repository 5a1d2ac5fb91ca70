#pragma once

#include "tabor/ehl/line/line.hpp"

namespace tabor::test {

/// Table 6 of Akchurin's thesis: HDPE on steel in glycerol-water, an arc of a ball as a line.
inline ehl::LineProblem table_6() {
  ehl::LineProblem problem;
  problem.radius = 2.5e-3;
  problem.effective_modulus = 1.05e9 / (1 - 0.35 * 0.35);
  problem.load = 5000;
  problem.entrainment_speed = 7.9e-3;
  problem.sliding_speed = 15.8e-3;
  problem.lubricant.viscosity = material::barus_viscosity(0.3638, 5.9e-9);
  problem.nodes = 600;
  return problem;
}

}  // namespace tabor::test
