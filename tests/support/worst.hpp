#pragma once

#include <cmath>
#include <initializer_list>

namespace tabor::test {

/// The larger error of two; NaN if either is, where std::max would forget it.
inline double worse(double a, double b) { return std::isnan(a) || a > b ? a : b; }

inline double worst_of(std::initializer_list<double> errors) {
  double worst = 0;
  for (const double error : errors) worst = worse(worst, error);
  return worst;
}

}  // namespace tabor::test
