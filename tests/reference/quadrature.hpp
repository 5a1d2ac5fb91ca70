#pragma once

#include <cmath>
#include <numbers>

namespace tabor::reference {

/// Integral of f over a disc of radius a, of a function of r. With r = a sin(t) the integrand of
/// square-root singularities at the edge is smooth, so that the midpoint rule converges.
template <typename Function>
double integral_over_disc(double a, const Function& f, int n = 20000) {
  const double step = 0.5 * std::numbers::pi / n;
  double sum = 0;
  for (int k = 0; k < n; ++k) {
    const double t = (k + 0.5) * step;
    sum += f(a * std::sin(t)) * std::sin(t) * std::cos(t);
  }
  return 2 * std::numbers::pi * a * a * sum * step;
}

}  // namespace tabor::reference
