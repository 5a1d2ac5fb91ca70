#pragma once

#include <Eigen/LU>

#include <functional>

#include "tabor/core/types.hpp"

namespace tabor::numerics {

/// Solves J x = b for a sequence of dense matrices J that change little from one to the next, with
/// a lagged factorisation: the factors of an earlier J precondition GMRES, and J is factorised anew
/// when that takes too many products. The solution reaches the tolerance whatever the age of the
/// factors.
class LaggedFactorisation {
 public:
  /// Computes y = J x, for x of the size of b.
  using Product = std::function<void(const Eigen::VectorXd& x, Eigen::VectorXd& y)>;
  /// Writes J into a matrix of zeros.
  using Assembly = std::function<void(Eigen::MatrixXd& matrix)>;

  /// Makes a solver without factors. `every_time`: one factorisation per solve, without GMRES.
  explicit LaggedFactorisation(bool every_time = false) : every_time_(every_time) {}

  /// Returns x with |b - J x| <= tolerance |b|. `product` applies J, `assemble` writes it.
  Eigen::VectorXd solve(const Eigen::VectorXd& b, double tolerance, const Product& product,
                        const Assembly& assemble);

  int n_factorisations() const { return n_factorisations_; }
  int n_products() const { return n_products_; }

 private:
  bool solve_with_old_factors(const Eigen::VectorXd& b, double tolerance, const Product& product,
                              Eigen::VectorXd& x);
  void factorise(Index n, const Assembly& assemble);

  bool every_time_;
  Eigen::MatrixXd matrix_;
  Eigen::PartialPivLU<Eigen::MatrixXd> factors_;
  int n_factorisations_ = 0;
  int n_products_ = 0;
  int products_since_ = 0;  // the last factorisation
};

}  // namespace tabor::numerics
