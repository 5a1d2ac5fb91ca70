#pragma once

#include <vector>

#include "tabor/core/random.hpp"
#include "tabor/deposition/even_rain.hpp"
#include "tabor/deposition/naive.hpp"
#include "tabor/deposition/pools.hpp"

namespace tabor::deposition::testing {

/// A tiny surface and a rain on it, all drawn from one number. Few distinct heights make many ties.
struct RandomCase {
  Terrain terrain;
  Reading reading = Reading::conserving;
  Height droplet = 1;
  std::uint64_t seed = 0;
  std::int64_t n_droplets = 0;
};

inline RandomCase random_case(std::uint64_t number, Pixel largest_side) {
  const CounterRandom random(number, 77);
  std::uint64_t k = 0;
  const auto below = [&](std::int64_t n) {
    return static_cast<std::int32_t>(random.below(k++, static_cast<std::uint64_t>(n)));
  };
  RandomCase result;
  result.terrain.nx = 1 + below(largest_side);
  result.terrain.ny = 1 + below(largest_side);
  result.terrain.edge = static_cast<Edge>(below(3));
  result.reading = static_cast<Reading>(below(2));
  const Height steps[] = {2, 3, 5, 9, 40, 1000};
  const Height n_heights = steps[below(6)];
  const Height step = 1 + below(below(2) == 0 ? 1 : 12);
  const Height range = n_heights * step;
  const Height droplets[] = {1, 2, 3, 7, 1 + range / 6, 2 * range};
  result.droplet = droplets[below(6)];
  result.seed = number;
  result.n_droplets = 1 + below(30 + 2 * result.terrain.size());
  result.terrain.height.resize(static_cast<std::size_t>(result.terrain.size()));
  for (Height& height : result.terrain.height) height = below(n_heights) * step;
  return result;
}

/// The levels that the fast engine's pools give each pixel.
inline std::vector<std::int64_t> levels_of(Pools& pools) {
  const Pixel n = pools.terrain().size();
  const Volume flood = pools.terrain().edge == Edge::open ? 0 : pools.beyond() / n;
  std::vector<std::int64_t> levels;
  for (Pixel p = 0; p < n; ++p) {
    const Height level = pools[pools.owner(pools.pool_at(p))].level;
    levels.push_back(std::max(level, pools.height(p)) + flood);
  }
  return levels;
}

}  // namespace tabor::deposition::testing
