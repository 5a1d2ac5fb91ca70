#include "tabor/numerics/lagged_factorisation.hpp"

#include "tabor/numerics/gmres.hpp"

namespace tabor::numerics {

namespace {

constexpr int kMaxProducts = 16;
/// As many products with their preconditioning as a factorisation of a few hundred unknowns costs.
constexpr int kWorthAFactorisation = 40;

}  // namespace

Eigen::VectorXd LaggedFactorisation::solve(const Eigen::VectorXd& b, double tolerance,
                                           const Product& product, const Assembly& assemble) {
  Eigen::VectorXd x = Eigen::VectorXd::Zero(b.size());
  if (b.norm() == 0) return x;
  const bool usable =
      !every_time_ && matrix_.rows() == b.size() && products_since_ < kWorthAFactorisation;
  if (usable && solve_with_old_factors(b, tolerance, product, x)) return x;
  factorise(b.size(), assemble);
  return factors_.solve(b);
}

void LaggedFactorisation::factorise(Index n, const Assembly& assemble) {
  matrix_.setZero(n, n);
  assemble(matrix_);
  factors_.compute(matrix_);
  ++n_factorisations_;
  products_since_ = 0;
}

bool LaggedFactorisation::solve_with_old_factors(const Eigen::VectorXd& b, double tolerance,
                                                 const Product& product, Eigen::VectorXd& x) {
  const int products_before = n_products_;
  const auto apply = [&](const Eigen::VectorXd& in) {
    Eigen::VectorXd out;
    product(in, out);
    return out;
  };
  const auto precondition = [&](const Eigen::VectorXd& in) -> Eigen::VectorXd {
    return factors_.solve(in);
  };
  const auto found = gmres(apply, precondition, b, tolerance, kMaxProducts, n_products_);
  products_since_ += n_products_ - products_before;
  if (found) x = *found;
  return found.has_value();
}

}  // namespace tabor::numerics
