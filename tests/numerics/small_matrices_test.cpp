#include "tabor/numerics/small_matrices.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>

namespace tabor::numerics {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

/// Of a line through points whose places and heights have units of very different size.
MatrixXd two_unknowns() {
  MatrixXd matrix(2, 2);
  matrix << 5e12, 3e3, 3e3, 2e-5;
  return matrix;
}

TEST(DeterminedInverse, IsTheInverseWhateverTheUnits) {
  const MatrixXd product = determined_inverse(two_unknowns()) * two_unknowns();
  EXPECT_NEAR(product(0, 0), 1, 1e-12);
  EXPECT_NEAR(product(1, 1), 1, 1e-12);
  EXPECT_NEAR(product(0, 1) * std::sqrt(5e12 / 2e-5), 0, 1e-12);
  EXPECT_NEAR(product(1, 0) * std::sqrt(2e-5 / 5e12), 0, 1e-12);
}

TEST(DeterminedInverse, LeavesWhatPointsDoNotDetermineAtZero) {
  // The second unknown has no entry; the first and the third only count together.
  MatrixXd matrix = MatrixXd::Zero(3, 3);
  matrix(0, 0) = matrix(2, 2) = matrix(0, 2) = matrix(2, 0) = 4;
  const VectorXd solution = determined_inverse(matrix) * (VectorXd(3) << 8, 0, 8).finished();
  EXPECT_NEAR(solution[0], 1, 1e-12);
  EXPECT_EQ(solution[1], 0);
  EXPECT_NEAR(solution[2], 1, 1e-12);
}

TEST(PseudoInverse, OfASingularMatrixGivesTheShortestSolution) {
  const MatrixXd matrix = Vector2d(1, 2) * Eigen::RowVector2d(3, 4);
  // Moore-Penrose inverse of u v^T is v u^T / (|u|^2 |v|^2).
  const MatrixXd expected = Vector2d(3, 4) * Eigen::RowVector2d(1, 2) / (5 * 25);
  EXPECT_LT((pseudo_inverse(matrix) - expected).cwiseAbs().maxCoeff(), 1e-15);
}

TEST(SymmetricEigenvalues, Ascend) {
  MatrixXd matrix(2, 2);
  matrix << 2, 1, 1, 2;
  const VectorXd values = symmetric_eigenvalues(matrix);
  EXPECT_NEAR(values[0], 1, 1e-14);
  EXPECT_NEAR(values[1], 3, 1e-14);
}

TEST(SolveSymmetric, FindsWhatTheMatrixWasMultipliedWith) {
  MatrixXd matrix(2, 2);
  matrix << 4, 1, 1, 3;
  const VectorXd solution = solve_symmetric(matrix, matrix * Vector2d(-2, 5));
  EXPECT_NEAR(solution[0], -2, 1e-14);
  EXPECT_NEAR(solution[1], 5, 1e-14);
}

TEST(LeastSquares, FitsTheMeanAndTheSlope) {
  MatrixXd line(3, 2);
  line << 1, 0, 1, 1, 1, 2;
  const VectorXd fit = least_squares(line, (VectorXd(3) << 1, 4, 4).finished());
  EXPECT_NEAR(fit[0], 1.5, 1e-14);
  EXPECT_NEAR(fit[1], 1.5, 1e-14);
}

TEST(LeastSquares, TheShortestSharesWhatTwoEqualColumnsCannotTellApart) {
  MatrixXd twice(3, 2);
  twice << 1, 1, 2, 2, 3, 3;
  const VectorXd fit = shortest_least_squares(twice, (VectorXd(3) << 4, 8, 12).finished());
  EXPECT_NEAR(fit[0], 2, 1e-14);
  EXPECT_NEAR(fit[1], 2, 1e-14);
}

}  // namespace
}  // namespace tabor::numerics
