#include "tabor/topography/digest.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "tabor/core/parallel.hpp"

namespace tabor::topography {
namespace {

constexpr Grid kGrid{301, 203, 301e-6, 203e-6};

Field heights() { return Field::Random(kGrid.ny, kGrid.nx); }

TEST(DigestOf, IsThatOfACopyOnAnyNumberOfThreads) {
  const Field height = heights();
  const std::uint64_t digest = digest_of(height, kGrid);
  EXPECT_NE(digest, 0U);
  for (const int threads : {1, 3}) {
    set_thread_count(threads);
    EXPECT_EQ(digest_of(Field(height), kGrid), digest) << threads;
  }
  set_thread_count(0);
}

TEST(DigestOf, SeesTheLastBitOfEveryHeight) {
  Field height = heights();
  std::set<std::uint64_t> seen = {digest_of(height, kGrid)};
  constexpr Index kStep = 97;  // all four lanes, several blocks
  std::size_t n = 1;
  for (Index p = 0; p < height.size(); p += kStep, ++n) {
    double& one = height.data()[p];
    const double before = one;
    one = std::nextafter(one, 2.0);
    seen.insert(digest_of(height, kGrid));
    one = before;
  }
  EXPECT_EQ(seen.size(), n);
}

TEST(DigestOf, SeesPlacesShapeAndSize) {
  const Field height = heights();
  const std::uint64_t digest = digest_of(height, kGrid);
  Field swapped = height;
  std::swap(swapped(0, 0), swapped(0, 4));  // of one lane
  EXPECT_NE(digest_of(swapped, kGrid), digest);
  std::swap(swapped(0, 0), swapped(100, 200));
  EXPECT_NE(digest_of(swapped, kGrid), digest);
  EXPECT_NE(digest_of(height, {kGrid.nx, kGrid.ny, kGrid.lx, 2 * kGrid.ly}), digest);
  EXPECT_NE(digest_of(height.reshaped<Eigen::RowMajor>(kGrid.nx, kGrid.ny), kGrid), digest);
  EXPECT_NE(digest_of(Field::Zero(4, 8), kGrid), digest_of(Field::Zero(8, 4), kGrid));
}

TEST(DigestOf, TakesBothZerosForOne) {
  Field height = Field::Zero(3, 5);
  const std::uint64_t digest = digest_of(height, kGrid);
  height(1, 1) = -0.0;
  EXPECT_EQ(digest_of(height, kGrid), digest);
  height(1, 1) = std::numeric_limits<double>::denorm_min();
  EXPECT_NE(digest_of(height, kGrid), digest);
}

}  // namespace
}  // namespace tabor::topography
