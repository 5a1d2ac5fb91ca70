#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "tabor/forming/friction_table.hpp"

namespace tabor::test {

/// Friction at a pressure [Pa], a density [kg/m^2] and a speed [m/s].
using Law = std::function<double(double pressure, double density, double speed)>;

/// A number at each of these; no speeds: friction does not depend on it.
inline forming::FrictionTable made_table(const std::vector<double>& pressures,
                                         const std::vector<double>& densities,
                                         const std::vector<double>& speeds, const Law& law) {
  std::vector<std::optional<double>> all_speeds(speeds.begin(), speeds.end());
  if (all_speeds.empty()) all_speeds.emplace_back();
  forming::FrictionTable table;
  table.group = "sheets before";
  table.origin = {"command: tabor table results"};
  for (const double density : densities) {
    for (const double pressure : pressures) {
      for (const std::optional<double> speed : all_speeds) {
        table.entries.push_back({.at = {pressure, density, speed},
                                 .friction = law(pressure, density, speed.value_or(0)),
                                 .standard_deviation = 0.01,
                                 .n = 3});
      }
    }
  }
  return table;
}

/// Another value everywhere.
inline double some_law(double pressure, double density, double speed) {
  return 0.3 - 5e-9 * pressure - 40 * density + 0.01 * speed;
}

}  // namespace tabor::test
