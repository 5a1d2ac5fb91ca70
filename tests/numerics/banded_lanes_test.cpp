// Banded systems side by side have the solutions that each of them has alone.
#include "tabor/numerics/banded_lanes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tabor/core/random.hpp"
#include "tabor/numerics/banded_lu.hpp"

namespace tabor::numerics {
namespace {

constexpr int kLower = 3, kUpper = 2;
using Systems = BandedLanes<kLower, kUpper>;

/// Entries of one random matrix after the other; small diagonals make rows change places.
template <typename Set>
void for_each_entry(Index n, double diagonal, const Set& set) {
  const CounterRandom random(7);
  std::uint64_t key = 0;
  for (int lane = 0; lane < kLanes; ++lane) {
    for (Index row = 0; row < n; ++row) {
      const Index last = std::min<Index>(n - 1, row + kUpper);
      for (Index column = std::max<Index>(0, row - kLower); column <= last; ++column) {
        set(lane, row, column, random.normal(key++) + (row == column ? diagonal : 0));
      }
    }
  }
}

TEST(BandedLanes, SolveEachSystemAsItIsSolvedAlone) {
  for (const Index n : {1, 2, 5, 40}) {
    for (const double diagonal : {0.0, 10.0}) {
      Systems systems(n);
      std::vector<BandedLu> alone(kLanes, BandedLu(n, kLower, kUpper));
      for_each_entry(n, diagonal, [&](int lane, Index row, Index column, double value) {
        systems.at(row, column)[lane] = value;
        alone[static_cast<std::size_t>(lane)].at(row, column) = value;
      });
      std::vector<Lanes> x(static_cast<std::size_t>(n + Systems::kPadding), Lanes{});
      for (Index i = 0; i < n; ++i) {
        x[static_cast<std::size_t>(i)] = in_all_lanes(std::sin(static_cast<double>(i)));
      }
      ASSERT_TRUE(systems.factorise());
      systems.solve(x.data());
      for (int lane = 0; lane < kLanes; ++lane) {
        Eigen::ArrayXd of_one = Eigen::ArrayXd::LinSpaced(n, 0, static_cast<double>(n - 1)).sin();
        ASSERT_TRUE(alone[static_cast<std::size_t>(lane)].factorise());
        alone[static_cast<std::size_t>(lane)].solve(of_one.data());
        for (Index i = 0; i < n; ++i) {
          EXPECT_NEAR(x[static_cast<std::size_t>(i)][lane], of_one[i],
                      1e-9 * of_one.abs().maxCoeff())
              << n << ", " << diagonal;
        }
      }
    }
  }
}

TEST(BandedLanes, OneSingularMatrixIsSaidOfAll) {
  Systems systems(4);
  for (Index i = 0; i < 4; ++i) systems.at(i, i) = in_all_lanes(1);
  systems.at(2, 2)[kLanes - 1] = 0;
  EXPECT_FALSE(systems.factorise());
}

}  // namespace
}  // namespace tabor::numerics
