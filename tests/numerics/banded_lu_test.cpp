#include "tabor/numerics/banded_lu.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <limits>

#include "numerics/matrices.hpp"
#include "support/worst.hpp"

namespace tabor::numerics {
namespace {

using test::scattered;

struct Band {
  Index n, lower, upper;
};

/// A band with small entries on the diagonal, so that rows must be exchanged.
Eigen::MatrixXd band_that_needs_pivots(const Band& band) {
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(band.n, band.n);
  for (Index i = 0; i < band.n; ++i) {
    const Index last = std::min(band.n - 1, i + band.upper);
    for (Index j = std::max<Index>(0, i - band.lower); j <= last; ++j) {
      matrix(i, j) = i == j ? 1e-13 : scattered(7 * i + j);
    }
  }
  return matrix;
}

BandedLu entered(const Eigen::MatrixXd& matrix, const Band& band) {
  BandedLu factors(band.n, band.lower, band.upper);
  for (Index i = 0; i < band.n; ++i) {
    const Index last = std::min(band.n - 1, i + band.upper);
    for (Index j = std::max<Index>(0, i - band.lower); j <= last; ++j) {
      factors.at(i, j) = matrix(i, j);
    }
  }
  return factors;
}

class BandedLuTest : public testing::TestWithParam<Band> {};

TEST_P(BandedLuTest, SolvesAsDenseFactorsDo) {
  const Eigen::MatrixXd matrix = band_that_needs_pivots(GetParam());
  BandedLu factors = entered(matrix, GetParam());
  EXPECT_EQ(factors.size(), GetParam().n);
  ASSERT_TRUE(factors.factorise());
  const Eigen::FullPivLU<Eigen::MatrixXd> dense(matrix);
  for (Index first = 0; first < 3; ++first) {  // the same factors serve many right sides
    const Eigen::VectorXd right = test::scattered_vector(GetParam().n, 100 * first);
    const Eigen::VectorXd expected = dense.solve(right);
    Eigen::VectorXd x = right;
    factors.solve(x.data());
    EXPECT_LE((x - expected).norm(), 1e-10 * expected.norm());
  }
}

INSTANTIATE_TEST_SUITE_P(Bands, BandedLuTest,
                         testing::Values(Band{40, 2, 3}, Band{40, 3, 2}, Band{37, 1, 1},
                                         Band{12, 5, 1}, Band{12, 1, 5}, Band{6, 5, 5}));

TEST(BandedLu, SolvesADiagonal) {
  BandedLu factors(3, 0, 0);
  for (Index i = 0; i < 3; ++i) factors.at(i, i) = static_cast<double>(i + 2);
  ASSERT_TRUE(factors.factorise());
  Eigen::Vector3d x(2, 3, 4);
  factors.solve(x.data());
  EXPECT_EQ(x, Eigen::Vector3d(1, 1, 1));
}

TEST(BandedLu, SaysThatAMatrixIsSingular) {
  BandedLu factors(3, 1, 1);
  factors.at(0, 0) = 1;
  factors.at(2, 2) = 1;
  EXPECT_FALSE(factors.factorise());
}

TEST(BandedLu, SaysThatAMatrixIsNotFinite) {
  for (const double value :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    BandedLu factors(2, 0, 0);
    factors.at(0, 0) = 1;
    factors.at(1, 1) = value;
    EXPECT_FALSE(factors.factorise());
  }
}

}  // namespace
}  // namespace tabor::numerics
