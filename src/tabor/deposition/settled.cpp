#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "tabor/core/error.hpp"
#include "tabor/core/loops.hpp"
#include "tabor/core/watch.hpp"
#include "tabor/deposition/catchments.hpp"
#include "tabor/deposition/deposition.hpp"
#include "tabor/deposition/film_measures.hpp"

namespace tabor::deposition {
namespace {

void check(const Field& height, const Grid& grid, const Field& thickness) {
  const auto fits = [&](const Field& map) {
    return map.rows() == grid.ny && map.cols() == grid.nx;
  };
  if (!fits(height) || !fits(thickness)) {
    throw InputError("liquid to settle",
                     fmt::format("{} x {} heights and {} x {} of liquid", height.cols(),
                                 height.rows(), thickness.cols(), thickness.rows()),
                     fmt::format("{} x {} as in the grid", grid.nx, grid.ny), "");
  }
  if (!all_finite(thickness) || thickness.minCoeff() < 0) {
    throw InputError("liquid to settle", "a thickness below zero or without end", "zero or more",
                     "");
  }
}

/// Thickness in whole quanta; what rounding takes from one pixel it gives to the next that is wet.
std::vector<Volume> quanta_of(const Field& thickness, double quantum) {
  std::vector<Volume> liquid(static_cast<std::size_t>(thickness.size()), 0);
  double carry = 0;
  for (std::size_t p = 0; p < liquid.size(); ++p) {
    go_on_or_throw(p);
    if (!(thickness.data()[p] > 0)) continue;
    carry += thickness.data()[p] / quantum;
    liquid[p] = std::max<Volume>(0, std::llround(carry));
    carry -= static_cast<double>(liquid[p]);
  }
  return liquid;
}

}  // namespace

Settled settle(const Field& height, const Grid& grid, const Field& thickness, Edge edge,
               const Observer& observer) {
  check(height, grid, thickness);
  const Watch watch(observer, "settle");
  const double volume = sum(thickness);
  Settled settled{.thickness = thickness};
  if (!(volume > 0)) return settled;
  const Terrain terrain = quantise(height, edge);
  Pools pools(terrain, Ties::ordered);
  Catchments(pools).drain(quanta_of(thickness, terrain.quantum));
  const auto n = static_cast<double>(terrain.size());
  const double run_off = edge == Edge::open ? static_cast<double>(pools.beyond()) : 0;
  settled.thickness = thickness_in(pools, (static_cast<double>(pools.beyond()) - run_off) / n);
  const double lost = std::min(run_off * terrain.quantum, volume);
  settled.lost = lost / n;
  // Levels are whole quanta: what that leaves out belongs to the wet pixels.
  const double kept = sum(settled.thickness);
  if (kept > 0) settled.thickness *= (volume - lost) / kept;
  return settled;
}

}  // namespace tabor::deposition
