#pragma once

#include <Eigen/Core>
#include <cmath>

#include "tabor/core/types.hpp"

namespace tabor::test {

/// A fixed series of numbers in -1 .. 1.
inline double scattered(Index i) { return std::sin(12.9898 * static_cast<double>(i + 1)); }

/// (scattered(first), scattered(first + 1), ...), n of them.
inline Eigen::VectorXd scattered_vector(Index n, Index first = 0) {
  return Eigen::VectorXd::NullaryExpr(n, [first](Index i) { return scattered(first + i); });
}

/// diagonal times the identity plus `share` times scattered entries.
inline Eigen::MatrixXd scattered_matrix(Index n, double diagonal, double share, Index first = 0) {
  Eigen::MatrixXd matrix = diagonal * Eigen::MatrixXd::Identity(n, n);
  for (Index i = 0; i < n * n; ++i) matrix.data()[i] += share * scattered(first + i);
  return matrix;
}

inline Field scattered_field(Index ny, Index nx, Index first = 0) {
  return Field::NullaryExpr(ny, nx,
                            [=](Index y, Index x) { return scattered(first + y * nx + x); });
}

}  // namespace tabor::test
