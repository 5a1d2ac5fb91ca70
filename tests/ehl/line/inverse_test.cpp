#include "tabor/ehl/line/inverse.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "tabor/numerics/gmres.hpp"

namespace tabor::ehl {
namespace {

/// A fixed series of numbers in -1 .. 1.
double scattered(Index i) { return std::sin(12.9898 * static_cast<double>(i + 1)); }

Eigen::MatrixXd dense_of(const LineBands& bands) {
  const Index n = bands.diagonal.size();
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n, n);
  matrix.diagonal() = bands.diagonal;
  matrix.diagonal(1) = bands.upper.head(n - 1);
  matrix.diagonal(-1) = bands.lower.tail(n - 1);
  return matrix;
}

/// A Newton step of some film: diffusion by pressure, transport by film.
class LineInverseTest : public testing::TestWithParam<Index> {};

TEST_P(LineInverseTest, LeavesAFewPerCentToGmres) {
  const Index n = GetParam();
  const LineUnits units{.pressure = 1e7, .film = 1e-5, .load = 5e3};
  const elastic::LineHalfSpace elastic(n, 1e-3 / static_cast<double>(n), 1.2e9);
  LineBands by_pressure(n);
  LineBands by_film(n);
  for (Index i = 0; i < n; ++i) {
    const double mobility = 1 + 0.5 * scattered(i);
    by_pressure.diagonal[i] = 2 * mobility;
    by_pressure.lower[i] = by_pressure.upper[i] = i == 0 || i + 1 == n ? 0 : -mobility;
    by_film.lower[i] = i == 0 || i + 1 == n ? 0 : -0.5;
    by_film.upper[i] = -by_film.lower[i];
    by_film.diagonal[i] = 0.3 * mobility;  // without it h0 would not matter
  }
  const Eigen::MatrixXd compliance = units.pressure / units.film * elastic.matrix();
  Eigen::MatrixXd matrix(n + 1, n + 1);
  matrix.topLeftCorner(n, n) = dense_of(by_pressure) + dense_of(by_film) * compliance;
  matrix.topRightCorner(n, 1) = dense_of(by_film) * Eigen::VectorXd::Ones(n);
  matrix.bottomLeftCorner(1, n).setConstant(elastic.load_weight() * units.pressure / units.load);
  matrix(n, n) = 0;
  const LineSystem system{&elastic, units, by_pressure, by_film};
  const LineInverse inverse(system);
  ASSERT_TRUE(inverse.ok());
  Eigen::VectorXd right(n + 1);
  for (Index i = 0; i <= n; ++i) right[i] = scattered(3 * i);
  int n_products = 0;
  const auto product = [&](const Eigen::VectorXd& x) -> Eigen::VectorXd { return matrix * x; };
  const auto x = numerics::gmres(product, inverse, right, 1e-6, 60, n_products);
  ASSERT_TRUE(x.has_value());
  EXPECT_LE((right - matrix * *x).norm(), 1.001e-6 * right.norm());
  EXPECT_LE(n_products, 20);
}

TEST_P(LineInverseTest, KnowsAsperities) {
  // From hardly touching to hardly apart: rows of P between dh = 0 and dP = 0.
  const Index n = GetParam();
  const elastic::LineHalfSpace elastic(n, 1e-3 / static_cast<double>(n), 1.2e9);
  LineSystem system{
      &elastic, {.pressure = 1e7, .film = 1e-5, .load = 5e3}, LineBands(n), LineBands(n)};
  system.by_pressure.diagonal.setConstant(2);
  system.by_pressure.lower.segment(1, n - 2).setConstant(-1);
  system.by_pressure.upper.segment(1, n - 2).setConstant(-1);
  system.by_film.diagonal.setConstant(0.3);
  system.touch = {Eigen::ArrayXd::Zero(n), Eigen::ArrayXd::Ones(n)};
  for (Index i = n / 3; i < 2 * n / 3; ++i) {
    system.touch.by_film[i] = 0.5 + 0.5 * scattered(i);
    system.touch.by_pressure[i] = 1 - system.touch.by_film[i];
  }
  const Eigen::MatrixXd matrix = system.dense();
  Eigen::VectorXd right(system.size());
  for (Index i = 0; i < right.size(); ++i) right[i] = scattered(3 * i);
  EXPECT_LE((matrix * right - system.product(right)).norm(), 1e-12 * (matrix * right).norm());
  const LineInverse inverse(system);
  ASSERT_TRUE(inverse.ok());
  int n_products = 0;
  const auto product = [&](const Eigen::VectorXd& x) { return system.product(x); };
  const auto x = numerics::gmres(product, inverse, right, 1e-6, 60, n_products);
  ASSERT_TRUE(x.has_value());
  EXPECT_LE((right - matrix * *x).norm(), 1.001e-6 * right.norm());
  EXPECT_LE(n_products, 30);
}

INSTANTIATE_TEST_SUITE_P(Sizes, LineInverseTest, testing::Values(50, 200, 800));

}  // namespace
}  // namespace tabor::ehl
