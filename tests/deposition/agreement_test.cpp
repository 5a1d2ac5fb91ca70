// The fast engine against the rule taken word for word, on tiny surfaces full of ties.
#include "deposition/agreement.hpp"

namespace tabor::deposition::testing {
namespace {

TEST(FastDeposition, AgreesWithTheNaiveRuleOnTinySurfacesFullOfTies) {
  expect_agreement(0, 8000, 6);
}

TEST(FastDeposition, AgreesWithTheNaiveRuleOnLargerSurfaces) { expect_agreement(1000000, 500, 14); }

// Pools of the limit, whose ties are ordered, after a rain.
TEST(FastDeposition, AgreesWithTheNaiveRuleOnPoolsThatServedTheLimitBefore) {
  std::uint64_t n_wrong = 0;
  for (std::uint64_t number = 0; number < 8000; ++number) {
    const RandomCase c = random_case(number, 8);
    Pools pools(c.terrain, Ties::ordered);
    rain_evenly(pools, {1, 7, 500}, [](std::size_t, const RainState&) {}, {});
    pools.connect_ties();
    const bool agrees = fast_engine_agrees(c, pools);
    EXPECT_TRUE(agrees || n_wrong > 0) << "case " << number;  // the first alone is named
    n_wrong += agrees ? 0 : 1;
  }
  EXPECT_EQ(n_wrong, 0U);
}

}  // namespace
}  // namespace tabor::deposition::testing
