#include "tabor/numerics/lagged_factorisation.hpp"

#include <gtest/gtest.h>

#include "support/worst.hpp"

namespace tabor::numerics {
namespace {

/// A well-conditioned matrix that drifts with time.
Eigen::MatrixXd matrix_at(double time) {
  const Index n = 60;
  Eigen::MatrixXd matrix(n, n);
  for (Index i = 0; i < n; ++i) {
    for (Index j = 0; j < n; ++j) {
      const double distance = 1 + std::abs(static_cast<double>(i - j));
      matrix(i, j) = std::cos(time + static_cast<double>(i)) / (distance * distance);
    }
    matrix(i, i) += 3;
  }
  return matrix;
}

struct Solved {
  double worst_residual = 0;
  int n_factorisations = 0;
};

Solved solve_series(bool every_time, double tolerance, double drift) {
  LaggedFactorisation solver(every_time);
  Solved solved;
  for (int i = 0; i < 12; ++i) {
    const Eigen::MatrixXd a = matrix_at(drift * i);
    const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(60, -1, 2);
    const Eigen::VectorXd x = solver.solve(
        b, tolerance, [&](const auto& in, auto& out) { out = a * in; },
        [&](auto& matrix) { matrix = a; });
    solved.worst_residual = test::worse(solved.worst_residual, (b - a * x).norm() / b.norm());
  }
  solved.n_factorisations = solver.n_factorisations();
  return solved;
}

TEST(LaggedFactorisation, ReachesItsToleranceWithOldFactors) {
  for (const double tolerance : {1e-3, 1e-9}) {
    const Solved solved = solve_series(false, tolerance, 0.01);
    EXPECT_LE(solved.worst_residual, tolerance * (1 + 1e-6));
    EXPECT_LT(solved.n_factorisations, 6);
  }
}

TEST(LaggedFactorisation, FactorisesAgainWhenTheMatrixHasBecomeAnother) {
  const Solved solved = solve_series(false, 1e-10, 1.5);
  EXPECT_LE(solved.worst_residual, 1e-9);
  EXPECT_GT(solved.n_factorisations, 1);
}

TEST(LaggedFactorisation, FactorisesEveryTimeWhenToldTo) {
  EXPECT_EQ(solve_series(true, 1e-3, 0.01).n_factorisations, 12);
}

}  // namespace
}  // namespace tabor::numerics
