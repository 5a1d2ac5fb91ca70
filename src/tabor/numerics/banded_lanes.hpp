#pragma once

#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "tabor/core/registers.hpp"
#include "tabor/core/types.hpp"

// Solves several banded systems of one size side by side, by vector instructions.
namespace tabor::numerics {

/// LU factors with partial pivoting of kLanes n x n matrices, whose entries lie at most `lower`
/// places below and `upper` places above the diagonal: what BandedLu does for one, in each lane.
template <int lower, int upper>
class BandedLanes {
 public:
  /// Values behind the n-th that solve() reads and that must be zero.
  static constexpr Index kPadding = lower + upper;

  explicit BandedLanes(Index n)
      : n_(n), band_(static_cast<std::size_t>((n + lower) * kWidth), Lanes{}) {}

  /// Entries of all matrices before factorise(); (row, column) inside the band. They start at zero.
  Lanes& at(Index row, Index column) { return band_[place(row, column)]; }

  /// Replaces the entries by the factors. False if a matrix is singular to working precision.
  bool factorise() {
    pivots_.assign(static_cast<std::size_t>(n_), Lanes{});
    moves_.assign(static_cast<std::size_t>(n_), false);
    for (Index k = 0; k < n_; ++k) {
      if (!choose_pivots(k)) return false;
      eliminate(k);
    }
    return true;
  }

  /// Sets x = matrix^-1 x in each lane: n values and kPadding zeros, after a factorise() that
  /// returned true.
  void solve(Lanes* x) const {
    for (Index k = 0; k < n_; ++k) {
      if (moves_[static_cast<std::size_t>(k)]) swap_values(k, x);
      for (int i = 1; i <= lower; ++i) x[k + i] -= band_[place(k + i, k)] * x[k];
    }
    for (Index k = n_ - 1; k >= 0; --k) {
      const Lanes* const row = &band_[place(k, k)];
      Lanes sum = x[k];
      for (int j = 1; j <= kPadding; ++j) sum -= row[j] * x[k + j];
      x[k] = sum * row[0];
    }
  }

 private:
  static constexpr Index kWidth = 2 * lower + upper + 1;  // pivoting moves rows to the right

  static std::size_t place(Index row, Index column) {
    return static_cast<std::size_t>(row * kWidth + column - row + lower);
  }
  static Lanes size_of(Lanes value) { return value < Lanes{} ? -value : value; }
  static bool any(const Lanes& flags) {
    bool found = false;
    for (int i = 0; i < kLanes; ++i) found = found || flags[i] != 0;
    return found;
  }
  static void swap_where(const Lanes& pivots, int row, Lanes& a, Lanes& b) {
    const Lanes wanted = in_all_lanes(row);
    const Lanes first = a;
    a = pivots == wanted ? b : a;
    b = pivots == wanted ? first : b;
  }

  /// Brings the largest entry of column k on or below the diagonal onto it.
  bool choose_pivots(Index k) {
    Lanes largest = size_of(at(k, k));
    Lanes& pivots = pivots_[static_cast<std::size_t>(k)];
    for (int i = 1; i <= lower; ++i) {
      const Lanes size = size_of(at(k + i, k));
      pivots = size > largest ? in_all_lanes(i) : pivots;
      largest = size > largest ? size : largest;
    }
    for (int lane = 0; lane < kLanes; ++lane) {
      if (!(largest[lane] > 0) || !std::isfinite(largest[lane])) return false;
    }
    if (!any(pivots)) return true;
    moves_[static_cast<std::size_t>(k)] = true;
    for (int i = 1; i <= lower; ++i) {
      for (int j = 0; j <= kPadding; ++j) swap_where(pivots, i, at(k, k + j), at(k + i, k + j));
    }
    return true;
  }

  /// The multipliers take the places of what they make zero; the diagonal becomes its inverse.
  void eliminate(Index k) {
    Lanes* const pivot_row = &at(k, k);
    pivot_row[0] = in_all_lanes(1) / pivot_row[0];
    for (int i = 1; i <= lower; ++i) {
      Lanes* const row = &at(k + i, k);
      row[0] *= pivot_row[0];
      for (int j = 1; j <= kPadding; ++j) row[j] -= row[0] * pivot_row[j];
    }
  }

  void swap_values(Index k, Lanes* x) const {
    for (int i = 1; i <= lower; ++i) {
      swap_where(pivots_[static_cast<std::size_t>(k)], i, x[k], x[k + i]);
    }
  }

  Index n_;
  std::vector<Lanes> band_;    // rows behind the n-th are zero
  std::vector<Lanes> pivots_;  // how far below the diagonal they lay
  std::vector<bool> moves_;    // any lane, in this row
};

}  // namespace tabor::numerics
