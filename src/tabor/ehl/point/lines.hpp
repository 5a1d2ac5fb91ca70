#pragma once

#include <Eigen/SparseLU>
#include <memory>
#include <vector>

#include "tabor/ehl/point/local.hpp"
#include "tabor/numerics/banded_lu.hpp"

// Smooths the errors of a point contact along lines of nodes.
namespace tabor::ehl {

/// Smooths the error of the local equations: lines of nodes along the flow, each solved exactly,
/// one after the other from side to side and back (line relaxation, Venner & Lubrecht 2000).
class PointLines {
 public:
  explicit PointLines(PointLocal local);

  bool ok() const { return ok_; }  ///< false: a line is singular
  /// Pressures that nearly balance `right`; zero at held nodes.
  Field operator()(const Field& right) const;

 private:
  void solve_line(Index j, const Field& right, Field& q) const;

  PointLocal local_;
  std::vector<numerics::BandedLu> lines_;
  bool ok_ = true;
};

/// Solves the local equations by sparse factors: for coarse grids.
class PointDirect {
 public:
  explicit PointDirect(PointLocal local);

  bool ok() const { return factors_->info() == Eigen::Success; }
  Field operator()(const Field& right) const;

 private:
  PointLocal local_;
  std::unique_ptr<Eigen::SparseLU<Eigen::SparseMatrix<double>>> factors_;
};

}  // namespace tabor::ehl
