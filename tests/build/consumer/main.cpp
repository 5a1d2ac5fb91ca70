// Presses a rigid flat on a wave and compares the contact with Westergaard's solution.
#include <cmath>
#include <cstdio>
#include <numbers>

#include "tabor/tabor.hpp"

int main() {
  const double length = 1e-3;
  const double modulus = tabor::material::effective_modulus({70e9, 0.33});
  const tabor::reference::WestergaardWave wave{1e-6, length, modulus};
  const tabor::Grid grid{128, 4, length, length / 32};

  tabor::contact::Problem problem;
  const double mean_pressure = 0.3 * wave.full_contact_pressure();
  problem.control = tabor::contact::MeanPressure{mean_pressure};
  problem.height.resize(grid.ny, grid.nx);
  for (tabor::Index x = 0; x < grid.nx; ++x) {
    const double phase =
        2 * std::numbers::pi * static_cast<double>(x) / static_cast<double>(grid.nx);
    problem.height.col(x).setConstant(wave.amplitude * std::cos(phase));
  }
  const auto elasticity = tabor::elastic::make_periodic(grid, modulus);
  const auto state = tabor::contact::solve(*elasticity, problem);

  const double expected = wave.pressure(mean_pressure, 0);
  const double found = state.pressure.maxCoeff();
  std::printf("largest pressure %.4g Pa, Westergaard %.4g Pa, certificate %.1e\n", found, expected,
              state.convergence.certificate);
  return state.convergence.converged() && std::abs(found / expected - 1) < 1e-3 ? 0 : 1;
}
