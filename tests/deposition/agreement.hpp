#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "deposition/random_terrain.hpp"
#include "support/validation.hpp"

namespace tabor::deposition::testing {

/// The naive rule's levels after a third of the droplets and after all, and the doses reached then.
struct Expected {
  std::vector<Volume> doses;
  std::vector<std::vector<std::int64_t>> levels;
  Volume lost = 0;
  std::int64_t n_droplets = 0;
};

inline Expected rain_naively(const RandomCase& c) {
  NaiveRain naive(c.terrain, c.reading);
  const CounterRandom starts(c.seed);
  Expected expected;
  Volume dosed = 0;
  for (const std::int64_t until : {c.n_droplets / 3 + 1, c.n_droplets + 1}) {
    for (; expected.n_droplets < until; ++expected.n_droplets) {
      const auto start = starts.below(static_cast<std::uint64_t>(expected.n_droplets),
                                      static_cast<std::uint64_t>(c.terrain.size()));
      dosed += naive.drop(static_cast<Pixel>(start), c.droplet);
    }
    expected.doses.push_back(dosed);
    expected.levels.push_back(naive.levels());
  }
  expected.lost = naive.lost();
  return expected;
}

/// True if the fast engine, on these pools of the surface, reaches the same doses with the same
/// levels, to the last bit.
inline bool fast_engine_agrees(const RandomCase& c, Pools& pools) {
  const Expected expected = rain_naively(c);
  bool agrees = true;
  RainState last;
  const auto compare = [&](std::size_t i, const RainState& state) {
    agrees &= state.dosed == expected.doses[i] && levels_of(pools) == expected.levels[i];
    last = state;
  };
  rain_droplets(pools, c.droplet, c.reading, c.seed, expected.doses, compare, {});
  agrees &= last.n_droplets == expected.n_droplets;
  agrees &= c.terrain.edge != Edge::open || pools.beyond() == expected.lost;
  return agrees;
}

inline bool fast_engine_agrees(const RandomCase& c) {
  Pools pools(c.terrain, Ties::connected);
  return fast_engine_agrees(c, pools);
}

inline void expect_agreement(std::uint64_t first, std::uint64_t count, Pixel largest_side) {
  std::uint64_t n_wrong = 0;
  for (std::uint64_t number = first; number < first + count; ++number) {
    const bool agrees = fast_engine_agrees(random_case(number, largest_side));
    EXPECT_TRUE(agrees || n_wrong > 0) << "case " << number;  // the first alone is named
    n_wrong += agrees ? 0 : 1;
  }
  test::expect_within("Deposition",
                      fmt::format("{} random surfaces up to {} x {}, ties, all edges and readings",
                                  count, largest_side, largest_side),
                      "surfaces with any other level or volume", "the rule taken word for word",
                      static_cast<double>(n_wrong), 0);
}

}  // namespace tabor::deposition::testing
