#include "tabor/ehl/stale_solver.hpp"

#include <gtest/gtest.h>

#include "support/worst.hpp"

namespace tabor::ehl {
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
  int n_factorizations = 0;
};

Solved solve_series(bool refactor_always, double tolerance, double drift) {
  StaleSolver solver(refactor_always);
  Solved solved;
  for (int i = 0; i < 12; ++i) {
    const Eigen::MatrixXd a = matrix_at(drift * i);
    const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(60, -1, 2);
    const Eigen::VectorXd x = solver.solve(
        b, tolerance, [&](const auto& in, auto& out) { out = a * in; },
        [&](auto& matrix) { matrix = a; });
    solved.worst_residual = test::worse(solved.worst_residual, (b - a * x).norm() / b.norm());
  }
  solved.n_factorizations = solver.n_factorizations();
  return solved;
}

TEST(StaleSolver, ReachesItsToleranceWithOldFactors) {
  for (const double tolerance : {1e-3, 1e-9}) {
    const Solved solved = solve_series(false, tolerance, 0.01);
    EXPECT_LE(solved.worst_residual, tolerance * (1 + 1e-6));
    EXPECT_LT(solved.n_factorizations, 6);
  }
}

TEST(StaleSolver, FactorizesAgainWhenTheMatrixHasBecomeAnother) {
  const Solved solved = solve_series(false, 1e-10, 1.5);
  EXPECT_LE(solved.worst_residual, 1e-9);
  EXPECT_GT(solved.n_factorizations, 1);
}

TEST(StaleSolver, FactorizesEveryTimeWhenToldTo) {
  EXPECT_EQ(solve_series(true, 1e-3, 0.01).n_factorizations, 12);
}

}  // namespace
}  // namespace tabor::ehl
