#pragma once

#include <Eigen/Core>

namespace tabor::numerics {

// Decompositions of the small matrices of fits. They are compiled here once: each place that takes
// them from Eigen's templates itself builds for half a minute.

/// Inverse of a symmetric positive matrix, scaled to a diagonal of ones, without the directions
/// whose eigenvalues are at most 1e-10 then: what the points of a fit do not determine stays zero.
Eigen::MatrixXd determined_inverse(const Eigen::MatrixXd& matrix);

/// Moore-Penrose inverse of a square matrix.
Eigen::MatrixXd pseudo_inverse(const Eigen::MatrixXd& matrix);

/// Eigenvalues of a symmetric matrix, ascending.
Eigen::VectorXd symmetric_eigenvalues(const Eigen::MatrixXd& matrix);

/// Solution of a symmetric positive definite system.
Eigen::VectorXd solve_symmetric(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& right);

/// x that makes |matrix x - right| least; columns of `matrix` are independent.
Eigen::VectorXd least_squares(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& right);

/// The shortest x of all that make |matrix x - right| least, whatever the columns of `matrix`.
Eigen::VectorXd shortest_least_squares(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& right);

}  // namespace tabor::numerics
