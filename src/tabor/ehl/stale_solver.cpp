#include "tabor/ehl/stale_solver.hpp"

#include <array>
#include <cmath>

namespace tabor::ehl {

namespace {

constexpr int kMaxProducts = 16;
/// As many products with their preconditioning as a factorization of a few hundred unknowns costs.
constexpr int kWorthAFactorization = 40;

/// The least-squares problem of GMRES, kept triangular by Givens rotations.
class Hessenberg {
 public:
  explicit Hessenberg(double norm) { right_[0] = norm; }

  /// Adds column k; returns the norm of the residual it leaves.
  double add(int k, std::array<double, kMaxProducts + 1>& column) {
    for (int i = 0; i < k; ++i) rotate(i, column);
    const double length = std::hypot(at(column, k), at(column, k + 1));
    at(cosine_, k) = length > 0 ? at(column, k) / length : 1;
    at(sine_, k) = length > 0 ? at(column, k + 1) / length : 0;
    rotate(k, column);
    for (int i = 0; i <= k; ++i) triangle_(i, k) = at(column, i);
    at(right_, k + 1) = -at(sine_, k) * at(right_, k);
    at(right_, k) *= at(cosine_, k);
    return std::abs(at(right_, k + 1));
  }

  Eigen::VectorXd weights(int n) const {
    const Eigen::VectorXd right = Eigen::Map<const Eigen::VectorXd>(right_.data(), n);
    return triangle_.topLeftCorner(n, n).triangularView<Eigen::Upper>().solve(right);
  }

 private:
  using Column = std::array<double, kMaxProducts + 1>;
  static double& at(Column& column, int i) { return column[static_cast<std::size_t>(i)]; }

  void rotate(int i, Column& column) {
    const double upper = at(column, i);
    const double lower = at(column, i + 1);
    at(column, i) = at(cosine_, i) * upper + at(sine_, i) * lower;
    at(column, i + 1) = at(cosine_, i) * lower - at(sine_, i) * upper;
  }

  Eigen::Matrix<double, kMaxProducts, kMaxProducts> triangle_;
  Column cosine_{}, sine_{}, right_{};
};

}  // namespace

Eigen::VectorXd StaleSolver::solve(const Eigen::VectorXd& b, double tolerance,
                                   const Product& product, const Assembly& assemble) {
  Eigen::VectorXd x = Eigen::VectorXd::Zero(b.size());
  if (b.norm() == 0) return x;
  const bool usable =
      !refactor_always_ && matrix_.rows() == b.size() && products_since_ < kWorthAFactorization;
  if (usable && gmres(b, tolerance, product, x)) return x;
  factorize(b.size(), assemble);
  return factors_.solve(b);
}

void StaleSolver::factorize(Index n, const Assembly& assemble) {
  matrix_.setZero(n, n);
  assemble(matrix_);
  factors_.compute(matrix_);
  ++n_factorizations_;
  products_since_ = 0;
}

// Saad, Iterative Methods for Sparse Linear Systems, algorithm 9.5: GMRES preconditioned on the
// right, so that the residual it watches is the true one.
bool StaleSolver::gmres(const Eigen::VectorXd& b, double tolerance, const Product& product,
                        Eigen::VectorXd& x) {
  const double norm = b.norm();
  Hessenberg problem(norm);
  Eigen::MatrixXd basis(b.size(), kMaxProducts + 1);
  Eigen::VectorXd image;
  basis.col(0) = b / norm;
  for (int k = 0; k < kMaxProducts; ++k) {
    product(factors_.solve(basis.col(k)), image);
    ++n_products_;
    ++products_since_;
    std::array<double, kMaxProducts + 1> column{};
    for (int i = 0; i <= k; ++i) {  // modified Gram-Schmidt
      const double share = basis.col(i).dot(image);
      column[static_cast<std::size_t>(i)] = share;
      image -= share * basis.col(i);
    }
    const double rest = image.norm();
    column[static_cast<std::size_t>(k) + 1] = rest;
    const double residual = problem.add(k, column);
    if (residual <= tolerance * norm) {
      x = factors_.solve(basis.leftCols(k + 1) * problem.weights(k + 1));
      return x.allFinite();
    }
    if (!(rest > 0)) return false;
    basis.col(k + 1) = image / rest;
  }
  return false;
}

}  // namespace tabor::ehl
