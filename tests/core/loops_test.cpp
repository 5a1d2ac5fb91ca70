#include "tabor/core/loops.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "tabor/core/rows.hpp"

namespace tabor {
namespace {

constexpr Index kMany = 3 * kBlock + 17;

class Loops : public testing::TestWithParam<int> {
 protected:
  Loops() { set_thread_count(GetParam()); }
  ~Loops() override { set_thread_count(0); }

  const Eigen::ArrayXd values_ = Eigen::ArrayXd::Random(kMany);
};

TEST_P(Loops, ForEachCallsOnceWithEveryIndex) {
  std::vector<int> calls(kMany, 0);
  for_each(calls.size(), [&](std::size_t i) { calls[i] += 1; });
  for_each(
      kMany, [&](Index i) { calls[static_cast<std::size_t>(i)] += 1; }, 64);
  EXPECT_EQ(std::count(calls.begin(), calls.end(), 2), kMany);
}

TEST_P(Loops, ForEachPixelCallsOnceWithEveryPixel) {
  Field map = Field::Zero(37, 11);
  for_each_pixel(map.rows(), map.cols(),
                 [&](Index y, Index x) { map(y, x) += 1 + static_cast<double>(100 * y + x); });
  for (Index y = 0; y < map.rows(); ++y) {
    for (Index x = 0; x < map.cols(); ++x) {
      EXPECT_EQ(map(y, x), 1 + static_cast<double>(100 * y + x));
    }
  }
}

TEST_P(Loops, SumAddsBlocksInOrder) {
  double expected = 0;
  for (Index begin = 0; begin < kMany; begin += kBlock) {
    double block = 0;
    for (Index i = begin; i < std::min(kMany, begin + kBlock); ++i) block += values_[i];
    expected += block;
  }
  EXPECT_EQ(sum_over(kMany, [&](Index i) { return values_[i]; }), expected);
  EXPECT_EQ(sum_over(0, [](Index) { return 1.0; }), 0);
}

TEST_P(Loops, CountAndSelectAgree) {
  const auto chosen = [&](Index i) { return values_[i] > 0.25; };
  const PixelList list = list_where(kMany, chosen);
  EXPECT_EQ(count_where(kMany, chosen), std::ssize(list));
  EXPECT_TRUE(std::is_sorted(list.begin(), list.end()));
  EXPECT_TRUE(std::all_of(list.begin(), list.end(), chosen));
  EXPECT_EQ(std::ssize(list), (values_ > 0.25).count());
  EXPECT_TRUE(list_where(0, chosen).empty());
}

TEST_P(Loops, LargestAndExtentAreThoseOfTheValues) {
  EXPECT_EQ(max_over(kMany, [&](Index i) { return values_[i]; }), values_.maxCoeff());
  EXPECT_EQ(max_over(0, [](Index) { return 1.0; }), -std::numeric_limits<double>::infinity());
  const Extent extent = extent_over(kMany, values_.data());
  EXPECT_EQ(extent.lowest, values_.minCoeff());
  EXPECT_EQ(extent.highest, values_.maxCoeff());
}

TEST_P(Loops, SumOverBlocksTakesTheSameBlocksOfAllArrays) {
  const Eigen::ArrayXf other = values_.cast<float>() * 2;
  const auto dot = [](const auto& a, const auto& b) {
    return (a * b.template cast<double>()).sum();
  };
  double expected = 0;
  for (Index i = 0; i < kMany; ++i) expected += values_[i] * static_cast<double>(other[i]);
  EXPECT_NEAR(sum_over_blocks(kMany, dot, values_.data(), other.data()), expected,
              1e-12 * static_cast<double>(kMany));
}

INSTANTIATE_TEST_SUITE_P(OnThreads, Loops, testing::Values(1, 2, 5));

}  // namespace
}  // namespace tabor
