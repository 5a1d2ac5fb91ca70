// The fast engine against the rule taken word for word, on tiny surfaces full of ties.
#include <gtest/gtest.h>

#include "lubrication/random_terrain.hpp"

namespace tabor::lubrication::testing {
namespace {

/// Rains on both, compares after a third of the droplets and at the end.
void expect_agreement(const RandomCase& c) {
  NaiveRain naive(c.terrain, c.reading);
  Pools pools(c.terrain, Ties::connected);
  const CounterRandom starts(c.seed);
  std::int64_t rained = 0;
  Volume dosed = 0;
  std::vector<Volume> doses;
  std::vector<std::vector<std::int64_t>> expected;
  for (const std::int64_t until : {c.n_droplets / 3 + 1, c.n_droplets + 1}) {
    for (; rained < until; ++rained) {
      const auto start = starts.below(static_cast<std::uint64_t>(rained),
                                      static_cast<std::uint64_t>(c.terrain.size()));
      dosed += naive.drop(static_cast<Pixel>(start), c.droplet);
    }
    doses.push_back(dosed);
    expected.push_back(naive.levels());
  }
  rain_droplets(
      pools, c.droplet, c.reading, c.seed, doses,
      [&](std::size_t i, const RainState& state) {
        ASSERT_EQ(state.dosed, doses[i]);
        ASSERT_EQ(levels_of(pools), expected[i]);
        if (i == 1) {
          ASSERT_EQ(state.n_droplets, rained);
          if (c.terrain.edge == Edge::open) {
            ASSERT_EQ(pools.beyond(), naive.lost());
          }
        }
      },
      {});
}

void expect_agreement_in(std::uint64_t first, std::uint64_t count, Pixel largest_side) {
  for (std::uint64_t number = first; number < first + count; ++number) {
    expect_agreement(random_case(number, largest_side));
    ASSERT_FALSE(::testing::Test::HasFailure()) << "case " << number;
  }
}

TEST(FastDeposition, AgreesWithTheNaiveRuleOnTinySurfacesFullOfTies) {
  expect_agreement_in(0, 4000, 6);
}

TEST(FastDeposition, AgreesWithTheNaiveRuleOnLargerSurfaces) { expect_agreement_in(50000, 300, 14); }

}  // namespace
}  // namespace tabor::lubrication::testing
