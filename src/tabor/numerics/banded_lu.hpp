#pragma once

#include <vector>

#include "tabor/core/types.hpp"

namespace tabor::numerics {

/// Solves banded systems by LU factors with partial pivoting of an n x n matrix whose entries lie
/// at most `lower` places below and `upper` places above the diagonal; O(n lower (lower + upper))
/// operations (Golub & Van Loan, Matrix Computations, 4th edition 2013, section 4.3).
class BandedLu {
 public:
  BandedLu(Index n, Index lower, Index upper);

  Index size() const { return n_; }
  /// Returns an entry of the matrix before factorise(); (row, column) inside the band. Starts at
  /// zero.
  double& at(Index row, Index column) { return band_[place(row, column)]; }
  /// Replaces the entries by the factors. False if the matrix is singular to working precision;
  /// throws Interrupted when the observer of the innermost Watch asks to stop.
  bool factorise();
  /// Sets x = matrix^-1 x, n values, after a factorise() that returned true.
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

}  // namespace tabor::numerics
