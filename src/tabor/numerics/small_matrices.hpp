#pragma once

#include <Eigen/Core>

// Decomposes the small matrices of fits. They are compiled here once: each place that takes them
// from Eigen's templates itself builds for half a minute.
namespace tabor::numerics {

/// Returns the inverse of a symmetric positive matrix, scaled to a diagonal of ones, without the
/// directions whose eigenvalues are then at most 1e-10: unknowns that the points of a fit do not
/// determine stay zero.
Eigen::MatrixXd determined_inverse(const Eigen::MatrixXd& matrix);

/// Returns the Moore-Penrose inverse of a square matrix.
Eigen::MatrixXd pseudo_inverse(const Eigen::MatrixXd& matrix);

/// Returns the eigenvalues of a symmetric matrix, ascending.
Eigen::VectorXd symmetric_eigenvalues(const Eigen::MatrixXd& matrix);

/// Returns the solution of a symmetric positive definite system.
Eigen::VectorXd solve_symmetric(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& right);

/// Returns the x that makes |matrix x - right| least; columns of `matrix` are independent.
Eigen::VectorXd least_squares(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& right);

/// Returns the shortest x of all that make |matrix x - right| least, whatever the columns of
/// `matrix`.
Eigen::VectorXd shortest_least_squares(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& right);

}  // namespace tabor::numerics
