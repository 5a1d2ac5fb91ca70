#include "tabor/numerics/small_matrices.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <cmath>

namespace tabor::numerics {

using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd determined_inverse(const MatrixXd& matrix) {
  const VectorXd scale = matrix.diagonal().unaryExpr(
      [](double entry) { return entry > 0 ? 1 / std::sqrt(entry) : 0.0; });
  const MatrixXd scaled = scale.asDiagonal() * matrix * scale.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(scaled);
  const VectorXd inverse =
      solver.eigenvalues().unaryExpr([](double value) { return value > 1e-10 ? 1 / value : 0.0; });
  const MatrixXd directions = scale.asDiagonal() * solver.eigenvectors();
  return directions * inverse.asDiagonal() * directions.transpose();
}

MatrixXd pseudo_inverse(const MatrixXd& matrix) {
  return matrix.completeOrthogonalDecomposition().pseudoInverse();
}

VectorXd symmetric_eigenvalues(const MatrixXd& matrix) {
  return Eigen::SelfAdjointEigenSolver<MatrixXd>(matrix, Eigen::EigenvaluesOnly).eigenvalues();
}

VectorXd solve_symmetric(const MatrixXd& matrix, const VectorXd& right) {
  return matrix.ldlt().solve(right);
}

VectorXd least_squares(const MatrixXd& matrix, const VectorXd& right) {
  return matrix.householderQr().solve(right);
}

VectorXd shortest_least_squares(const MatrixXd& matrix, const VectorXd& right) {
  return matrix.completeOrthogonalDecomposition().solve(right);
}

}  // namespace tabor::numerics
