#include "tabor/core/random.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace tabor {
namespace {

// Known answers of Philox 4x32-10 published with Random123 (Salmon et al. 2011): counter and key
// all zero, and all ones.
TEST(CounterRandom, GivesThePublishedPhiloxNumbers) {
  EXPECT_EQ(CounterRandom(0, 0).bits(0), 0xe169c58d6627e8d5ULL);
  const std::uint64_t ones = ~0ULL;
  EXPECT_EQ(CounterRandom(ones, ones).bits(ones), 0x41c83b0e408f276dULL);
}

TEST(CounterRandom, UniformNumbersHaveTheirMeanAndVariance) {
  const CounterRandom random(7);
  const int n = 200000;
  double sum = 0;
  double squares = 0;
  for (int k = 0; k < n; ++k) {
    const double u = random.uniform(static_cast<std::uint64_t>(k));
    ASSERT_GE(u, 0.0);
    ASSERT_LT(u, 1.0);
    sum += u;
    squares += u * u;
  }
  const double five_sigma = 5 / std::sqrt(12.0 * n);
  EXPECT_NEAR(sum / n, 0.5, five_sigma);
  EXPECT_NEAR(squares / n, 1.0 / 3, five_sigma);
}

TEST(CounterRandom, NormalNumbersHaveTheirMoments) {
  const CounterRandom random(3);
  const int n = 200000;
  double sum = 0;
  double squares = 0;
  for (int k = 0; k < n; ++k) {
    const double z = random.normal(static_cast<std::uint64_t>(k));
    sum += z;
    squares += z * z;
  }
  EXPECT_NEAR(sum / n, 0, 5 / std::sqrt(double(n)));
  EXPECT_NEAR(squares / n, 1, 5 * std::sqrt(2.0 / n));
}

TEST(CounterRandom, BelowReachesEveryValueAndNoMore) {
  const CounterRandom random(1);
  std::array<int, 7> counts{};
  for (std::uint64_t k = 0; k < 7000; ++k) {
    counts.at(random.below(k, 7)) += 1;  // at() throws beyond the end
  }
  for (const int count : counts) {
    EXPECT_NEAR(count, 1000, 200);
  }
}

TEST(CounterRandom, SeedsAndStreamsDiffer) {
  EXPECT_NE(CounterRandom(1).bits(0), CounterRandom(2).bits(0));
  EXPECT_NE(CounterRandom(1, 0).bits(0), CounterRandom(1, 1).bits(0));
}

}  // namespace
}  // namespace tabor
