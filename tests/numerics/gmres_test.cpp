#include "tabor/numerics/gmres.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "numerics/matrices.hpp"
#include "tabor/core/error.hpp"
#include "tabor/core/watch.hpp"

namespace tabor::numerics {
namespace {

constexpr Index kSize = 30;

VectorMap times(const Eigen::MatrixXd& matrix) {
  return [&matrix](const Eigen::VectorXd& x) -> Eigen::VectorXd { return matrix * x; };
}

Eigen::VectorXd unchanged(const Eigen::VectorXd& b) { return b; }

TEST(Gmres, FindsWhatDenseFactorsFind) {
  const Eigen::MatrixXd matrix = test::scattered_matrix(kSize, 3, 0.125);
  const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(kSize, 1, -3);
  int n_products = 0;
  const auto x = gmres(times(matrix), unchanged, b, 1e-12, kSize, n_products);
  ASSERT_TRUE(x.has_value());
  const Eigen::VectorXd expected = matrix.partialPivLu().solve(b);
  EXPECT_LE((*x - expected).norm(), 1e-11 * expected.norm());
}

TEST(Gmres, ReachesTheToleranceOrSaysThatItDidNot) {
  const Eigen::MatrixXd matrix = test::scattered_matrix(kSize, 3, 0.125);
  const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(kSize, 1, -3);
  int n_products = 0;
  const auto x = gmres(times(matrix), unchanged, b, 1e-10, kSize, n_products);
  ASSERT_TRUE(x.has_value());
  EXPECT_LE((b - matrix * *x).norm(), 1.001e-10 * b.norm());
  EXPECT_GT(n_products, 2);
  EXPECT_FALSE(gmres(times(matrix), unchanged, b, 1e-10, 2, n_products).has_value());
}

TEST(Gmres, NeedsAsManyProductsAsThereAreEigenvalues) {
  // The minimal polynomial of the matrix has this degree.
  Eigen::VectorXd diagonal(kSize);
  for (Index i = 0; i < kSize; ++i) diagonal[i] = i % 3 == 0 ? 1 : (i % 3 == 1 ? 4 : 9);
  const Eigen::MatrixXd matrix = diagonal.asDiagonal();
  int n_products = 0;
  const Eigen::VectorXd b = test::scattered_vector(kSize);
  ASSERT_TRUE(gmres(times(matrix), unchanged, b, 1e-12, kSize, n_products).has_value());
  EXPECT_EQ(n_products, 3);
}

TEST(Gmres, NeedsOneProductWithTheInverseAsPreconditioner) {
  const Eigen::MatrixXd matrix = test::scattered_matrix(kSize, 3, 0.125);
  const Eigen::MatrixXd inverse = matrix.inverse();
  int n_products = 0;
  const Eigen::VectorXd b = test::scattered_vector(kSize);
  const auto x = gmres(times(matrix), times(inverse), b, 1e-10, kSize, n_products);
  ASSERT_TRUE(x.has_value());
  EXPECT_EQ(n_products, 1);
  EXPECT_LE((b - matrix * *x).norm(), 1.001e-10 * b.norm());
}

TEST(Gmres, AnswersZeroWithZeroAndNoProduct) {
  const Eigen::MatrixXd matrix = test::scattered_matrix(kSize, 3, 0.125);
  int n_products = 0;
  const auto x =
      gmres(times(matrix), unchanged, Eigen::VectorXd::Zero(kSize), 1e-10, kSize, n_products);
  ASSERT_TRUE(x.has_value());
  EXPECT_EQ(*x, Eigen::VectorXd::Zero(kSize));
  EXPECT_EQ(n_products, 0);
}

TEST(Gmres, SaysThatASingularSystemHasNoSolution) {
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(2, 2);
  matrix(0, 0) = 1;
  int n_products = 0;
  const Eigen::VectorXd b = Eigen::Vector2d(0, 1);
  EXPECT_FALSE(gmres(times(matrix), unchanged, b, 1e-10, 2, n_products).has_value());
}

TEST(Gmres, StopsWhenTheObserverAsks) {
  const Eigen::MatrixXd matrix = test::scattered_matrix(kSize, 3, 0.125);
  int n_asked = 0;
  const Observer observer = [&](const Progress&) { return ++n_asked < 2; };
  int n_products = 0;
  set_watch_period(0);
  const auto watched = [&] {
    const Watch watch(observer, "test");
    gmres(times(matrix), unchanged, test::scattered_vector(kSize), 1e-10, kSize, n_products);
  };
  EXPECT_THROW(watched(), Interrupted);
  set_watch_period(kWatchPeriod);
  EXPECT_EQ(n_products, 0);
}

}  // namespace
}  // namespace tabor::numerics
