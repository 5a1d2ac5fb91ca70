#pragma once

#include <vector>

#include "tabor/core/types.hpp"

namespace tabor::ehl {

/// LU factors with partial pivoting of a square matrix whose entries lie at most `lower` places
/// below and `upper` places above the diagonal.
class BandedLu {
 public:
  BandedLu(Index n, Index lower, Index upper);

  Index size() const { return n_; }
  /// An entry of the matrix before factorize(); (row, column) inside the band. Starts at zero.
  double& at(Index row, Index column) { return band_[place(row, column)]; }
  /// False if the matrix is singular to working precision.
  bool factorize();
  /// x = matrix^-1 x, n values.
  void solve(double* x) const;

 private:
  std::size_t place(Index row, Index column) const {
    return static_cast<std::size_t>(row * width_ + column - row + lower_);
  }
  void eliminate(Index k);

  Index n_, lower_, upper_, width_;  // rows keep `lower` more places for what pivoting moves there
  std::vector<double> band_, multipliers_;
  std::vector<Index> pivots_;
};

}  // namespace tabor::ehl
