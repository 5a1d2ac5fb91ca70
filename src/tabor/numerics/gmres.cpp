#include "tabor/numerics/gmres.hpp"

#include <cmath>

#include "tabor/core/watch.hpp"

namespace tabor::numerics {
namespace {

/// Solves the least-squares problem of GMRES, made triangular by Givens rotations.
class Hessenberg {
 public:
  Hessenberg(int size, double norm)
      : triangle_(Eigen::MatrixXd::Zero(size, size)),
        cosine_(size),
        sine_(size),
        right_(Eigen::VectorXd::Zero(size + 1)) {
    right_[0] = norm;
  }

  /// Adds column k, which has k + 2 entries; returns the norm of the residual it leaves.
  double add(int k, Eigen::VectorXd column) {
    for (int i = 0; i < k; ++i) rotate(i, column);
    const double length = std::hypot(column[k], column[k + 1]);
    cosine_[k] = length > 0 ? column[k] / length : 1;
    sine_[k] = length > 0 ? column[k + 1] / length : 0;
    rotate(k, column);
    triangle_.col(k).head(k + 1) = column.head(k + 1);
    right_[k + 1] = -sine_[k] * right_[k];
    right_[k] *= cosine_[k];
    return std::abs(right_[k + 1]);
  }

  Eigen::VectorXd weights(int n) const {
    return triangle_.topLeftCorner(n, n).triangularView<Eigen::Upper>().solve(right_.head(n));
  }

 private:
  void rotate(int i, Eigen::VectorXd& column) const {
    const double upper = column[i];
    const double lower = column[i + 1];
    column[i] = cosine_[i] * upper + sine_[i] * lower;
    column[i + 1] = cosine_[i] * lower - sine_[i] * upper;
  }

  Eigen::MatrixXd triangle_;
  Eigen::VectorXd cosine_, sine_, right_;
};

}  // namespace

std::optional<Eigen::VectorXd> gmres(const VectorMap& product, const VectorMap& precondition,
                                     const Eigen::VectorXd& b, double tolerance, int max_products,
                                     int& n_products) {
  const double norm = b.norm();
  if (norm == 0) return Eigen::VectorXd::Zero(b.size());
  Hessenberg problem(max_products, norm);
  Eigen::MatrixXd basis(b.size(), max_products + 1);
  basis.col(0) = b / norm;
  for (int k = 0; k < max_products; ++k) {
    go_on_or_throw();
    Eigen::VectorXd image = product(precondition(basis.col(k)));
    ++n_products;
    Eigen::VectorXd column(k + 2);
    for (int i = 0; i <= k; ++i) {  // modified Gram-Schmidt
      column[i] = basis.col(i).dot(image);
      image -= column[i] * basis.col(i);
    }
    const double rest = image.norm();
    column[k + 1] = rest;
    if (problem.add(k, column) <= tolerance * norm) {
      Eigen::VectorXd x = precondition(basis.leftCols(k + 1) * problem.weights(k + 1));
      if (!x.allFinite()) return std::nullopt;
      return x;
    }
    if (!(rest > 0)) return std::nullopt;
    basis.col(k + 1) = image / rest;
  }
  return std::nullopt;
}

}  // namespace tabor::numerics
