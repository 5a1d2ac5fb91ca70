#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

#include "tabor/reynolds/patch/patch_flow.hpp"

namespace tabor::test {

/// A patch one row high with pixels of 1 um; 0.1 Pa s, 1 mm/s.
inline reynolds::PatchProblem row_patch(const Field& gap) {
  reynolds::PatchProblem problem;
  problem.gap = gap;
  problem.grid = {gap.cols(), gap.rows(), 1e-6 * static_cast<double>(gap.cols()),
                  1e-6 * static_cast<double>(gap.rows())};
  problem.viscosity = 0.1;
  problem.entrainment_speed = 1e-3;
  return problem;
}

/// n x n pixels of a rough gap with some waves of random phase, rms 0.5 um, whose mean plane is
/// `separation` away from the flat; what would be closer than zero is wall.
inline reynolds::PatchProblem rough_patch(Index n, double separation) {
  Field height = Field::Zero(n, n);
  const double step = 2 * std::numbers::pi / static_cast<double>(n);
  std::uint64_t wave = 0;
  for (int k = 0; k <= 5; ++k) {
    for (int l = k == 0 ? 1 : -5; l <= 5; ++l) {
      const double phase =
          2 * std::numbers::pi * static_cast<double>(wave++ * 2654435761u % 1000) / 1000;
      const double amplitude = 1 / (2.0 + k * k + l * l);
      for (Index row = 0; row < n; ++row) {
        for (Index column = 0; column < n; ++column) {
          height(row, column) +=
              amplitude * std::cos(step * static_cast<double>(k * column + l * row) + phase);
        }
      }
    }
  }
  height *= 0.5e-6 / std::sqrt(height.square().mean());
  reynolds::PatchProblem problem = row_patch((separation - height).max(0.0));
  return problem;
}

}  // namespace tabor::test
