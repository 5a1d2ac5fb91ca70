#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "tabor/core/parallel.hpp"
#include "tabor/core/random.hpp"
#include "tabor/topography/topography.hpp"

namespace tabor::test {

inline constexpr double kHole = std::numeric_limits<double>::quiet_NaN();
using std::numbers::pi;

/// height(x, y) [m] at the pixel centres, which lie at ((i + 1/2) dx, (j + 1/2) dy).
template <typename Height>
topography::Topography surface(const Grid& grid, const Height& height) {
  topography::Topography topography;
  topography.grid = grid;
  topography.height.resize(grid.ny, grid.nx);
  for (Index y = 0; y < grid.ny; ++y) {
    for (Index x = 0; x < grid.nx; ++x) {
      topography.height(y, x) = height((static_cast<double>(x) + 0.5) * grid.dx(),
                                       (static_cast<double>(y) + 0.5) * grid.dy());
    }
  }
  return topography;
}

/// White noise of 1 um rms plus a tilt: nothing about it is symmetric or periodic.
inline topography::Topography noise(const Grid& grid, std::uint64_t seed = 1) {
  const CounterRandom random(seed);
  std::uint64_t k = 0;
  return surface(
      grid, [&](double x, double y) { return 1e-6 * random.normal(k++) + 0.01 * x - 0.003 * y; });
}

/// Every pixel is missing with the given probability.
inline void punch_holes(topography::Topography& topography, double share, std::uint64_t seed = 7) {
  const CounterRandom random(seed);
  for (Index i = 0; i < topography.height.size(); ++i) {
    if (random.uniform(static_cast<std::uint64_t>(i)) < share) topography.height.data()[i] = kHole;
  }
}

/// Largest difference of two maps; holes must be in the same places.
inline double largest_difference(const Field& a, const Field& b) {
  EXPECT_EQ(a.rows(), b.rows());
  EXPECT_EQ(a.cols(), b.cols());
  EXPECT_TRUE((a.isNaN() == b.isNaN()).all());
  return (a - b).isNaN().select(0, (a - b).abs()).maxCoeff();
}

inline bool same_bits(const Field& a, const Field& b) {
  return a.rows() == b.rows() && a.cols() == b.cols() &&
         ((a == b) || (a.isNaN() && b.isNaN())).all();
}

/// The result of make() on one thread and on four.
template <typename Make>
void expect_same_bits_on_any_threads(const Make& make) {
  set_thread_count(1);
  const Field one = make();
  set_thread_count(4);
  const Field four = make();
  set_thread_count(0);
  EXPECT_TRUE(same_bits(one, four));
}

}  // namespace tabor::test
