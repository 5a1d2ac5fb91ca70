#pragma once

#include <algorithm>
#include <cmath>

namespace tabor::material {

/// Central difference of fourth order: its error is about 1e-11 of f where f varies on the scale of
/// 100 steps.
template <typename Function>
double difference(const Function& f, double x, double step) {
  return (8 * (f(x + step) - f(x - step)) - (f(x + 2 * step) - f(x - 2 * step))) / (12 * step);
}

/// |a - b| relative to the larger of |b| and `scale`.
inline double relative_error(double a, double b, double scale) {
  return std::abs(a - b) / std::max(std::abs(b), scale);
}

}  // namespace tabor::material
