#include "tabor/numerics/banded_lu.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tabor/core/watch.hpp"

namespace tabor::numerics {

BandedLu::BandedLu(Index n, Index lower, Index upper)
    : n_(n),
      lower_(lower),
      upper_(upper),
      width_(2 * lower + upper + 1),
      band_(static_cast<std::size_t>(n * width_), 0.0),
      multipliers_(static_cast<std::size_t>(n * lower), 0.0),
      pivots_(static_cast<std::size_t>(n), 0) {}

bool BandedLu::factorise() {
  for (Index k = 0; k < n_; ++k) {
    go_on_or_throw();
    const Index last_row = std::min(n_ - 1, k + lower_);
    Index pivot = k;
    for (Index i = k + 1; i <= last_row; ++i) {
      if (std::abs(at(i, k)) > std::abs(at(pivot, k))) pivot = i;
    }
    pivots_[static_cast<std::size_t>(k)] = pivot;
    if (!(std::abs(at(pivot, k)) > 0) || !std::isfinite(at(pivot, k))) return false;
    if (pivot != k) {
      const Index last_column = std::min(n_ - 1, k + lower_ + upper_);
      for (Index j = k; j <= last_column; ++j) std::swap(at(k, j), at(pivot, j));
    }
    eliminate(k);
  }
  return true;
}

void BandedLu::eliminate(Index k) {
  const Index last_row = std::min(n_ - 1, k + lower_);
  const Index n_columns = std::min(n_ - 1, k + lower_ + upper_) - k;
  const double* const pivot_row = &at(k, k);
  for (Index i = k + 1; i <= last_row; ++i) {
    double* const row = &at(i, k);
    const double factor = row[0] / pivot_row[0];
    multipliers_[static_cast<std::size_t>(k * lower_ + i - k - 1)] = factor;
    if (factor == 0) continue;
    for (Index j = 1; j <= n_columns; ++j) row[j] -= factor * pivot_row[j];
  }
}

void BandedLu::solve(double* x) const {
  for (Index k = 0; k < n_; ++k) {
    std::swap(x[k], x[pivots_[static_cast<std::size_t>(k)]]);
    const Index last_row = std::min(n_ - 1, k + lower_);
    for (Index i = k + 1; i <= last_row; ++i) {
      x[i] -= multipliers_[static_cast<std::size_t>(k * lower_ + i - k - 1)] * x[k];
    }
  }
  for (Index k = n_ - 1; k >= 0; --k) {
    const Index n_columns = std::min(n_ - 1, k + lower_ + upper_) - k;
    const double* const row = &band_[place(k, k)];
    double sum = x[k];
    for (Index j = 1; j <= n_columns; ++j) sum -= row[j] * x[k + j];
    x[k] = sum / row[0];
  }
}

}  // namespace tabor::numerics
