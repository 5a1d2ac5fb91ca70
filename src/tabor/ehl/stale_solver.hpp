#pragma once

#include <Eigen/LU>

#include <functional>

#include "tabor/core/types.hpp"

namespace tabor::ehl {

/// Solves J x = b for a sequence of dense matrices J that change little from one to the next: GMRES
/// with the last factorization as preconditioner, and a new factorization when that takes too many
/// products. The solution is as exact as asked for whatever the age of the factorization.
class StaleSolver {
 public:
  using Product = std::function<void(const Eigen::VectorXd& x, Eigen::VectorXd& y)>;
  using Assembly = std::function<void(Eigen::MatrixXd& matrix)>;

  /// `refactor_always` is the plain way: one factorization per solve.
  explicit StaleSolver(bool refactor_always = false) : refactor_always_(refactor_always) {}

  /// x with |b - J x| <= tolerance |b|. `product` applies J, `assemble` writes it.
  Eigen::VectorXd solve(const Eigen::VectorXd& b, double tolerance, const Product& product,
                        const Assembly& assemble);

  int n_factorizations() const { return n_factorizations_; }
  int n_products() const { return n_products_; }

 private:
  bool gmres(const Eigen::VectorXd& b, double tolerance, const Product& product,
             Eigen::VectorXd& x);
  void factorize(Index n, const Assembly& assemble);

  bool refactor_always_;
  Eigen::MatrixXd matrix_;
  Eigen::PartialPivLU<Eigen::MatrixXd> factors_;
  int n_factorizations_ = 0;
  int n_products_ = 0;
  int products_since_ = 0;  // the last factorization
};

}  // namespace tabor::ehl
