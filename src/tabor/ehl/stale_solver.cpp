#include "tabor/ehl/stale_solver.hpp"

#include "tabor/ehl/gmres.hpp"

namespace tabor::ehl {

namespace {

constexpr int kMaxProducts = 16;
/// As many products with their preconditioning as a factorization of a few hundred unknowns costs.
constexpr int kWorthAFactorization = 40;

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

bool StaleSolver::gmres(const Eigen::VectorXd& b, double tolerance, const Product& product,
                        Eigen::VectorXd& x) {
  const int products_before = n_products_;
  const auto apply = [&](const Eigen::VectorXd& in) {
    Eigen::VectorXd out;
    product(in, out);
    return out;
  };
  const auto precondition = [&](const Eigen::VectorXd& in) -> Eigen::VectorXd {
    return factors_.solve(in);
  };
  const auto found = ehl::gmres(apply, precondition, b, tolerance, kMaxProducts, n_products_);
  products_since_ += n_products_ - products_before;
  if (found) x = *found;
  return found.has_value();
}

}  // namespace tabor::ehl
