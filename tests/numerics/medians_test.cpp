// Medians of lists side by side are those of each list sorted.
#include "tabor/numerics/medians.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tabor/core/random.hpp"

namespace tabor::numerics {
namespace {

TEST(UpperMedians, AreThoseOfSortedLists) {
  const CounterRandom random(3);
  std::uint64_t key = 0;
  for (const bool has_ties : {false, true}) {
    for (std::size_t n = 1; n <= 60; ++n) {
      std::vector<Lanes> lanes(n);
      std::vector<std::vector<double>> lists(kLanes, std::vector<double>(n));
      for (std::size_t i = 0; i < kLanes; ++i) {
        for (std::size_t j = 0; j < n; ++j) {
          const double value = random.normal(key++);
          lists[i][j] = has_ties ? std::round(value) : value;
          lanes[j][i] = lists[i][j];
        }
      }
      const Lanes& medians = upper_medians(lanes);
      for (std::size_t i = 0; i < kLanes; ++i) {
        std::sort(lists[i].begin(), lists[i].end());
        EXPECT_EQ(medians[i], lists[i][n / 2]) << n << " values";
      }
    }
  }
}

}  // namespace
}  // namespace tabor::numerics
