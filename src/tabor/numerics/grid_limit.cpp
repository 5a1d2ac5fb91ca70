#include "tabor/numerics/grid_limit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace tabor::numerics {

namespace {

constexpr double kLowestOrder = 0.5, kHighestOrder = 10;
constexpr double kEqual = 1e-9;  // relative: values that do not depend on the grid
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// (coarse^p - medium^p) / (medium^p - fine^p); grows with p.
double ratio_at(double order, const double (&spacing)[3]) {
  const double coarse = std::pow(spacing[0] / spacing[1], order);
  const double fine = std::pow(spacing[2] / spacing[1], order);
  return (coarse - 1) / (1 - fine);
}

/// The order at which errors differ as the values do; NaN outside the orders that are believable.
double order_of(double ratio, const double (&spacing)[3]) {
  double low = kLowestOrder, high = kHighestOrder;
  if (!(ratio >= ratio_at(low, spacing) && ratio <= ratio_at(high, spacing))) return kNone;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (ratio_at(middle, spacing) < ratio ? low : high) = middle;
  }
  return (low + high) / 2;
}

}  // namespace

GridLimit limit_of(const std::vector<double>& spacing, const std::vector<double>& value) {
  std::vector<std::size_t> place(spacing.size());
  std::iota(place.begin(), place.end(), std::size_t{0});
  std::sort(place.begin(), place.end(),
            [&](std::size_t a, std::size_t b) { return spacing[a] > spacing[b]; });
  double h[3], f[3];
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t at = place[place.size() - 3 + i];
    h[i] = spacing[at];
    f[i] = value[at];
  }
  if (std::abs(f[2] - f[1]) <= kEqual * std::abs(f[2])) return {f[2], kNone};
  const double order = order_of((f[1] - f[0]) / (f[2] - f[1]), h);
  if (std::isnan(order)) return {kNone, kNone};
  const double fine = std::pow(h[2] / h[1], order);
  return {f[2] + (f[2] - f[1]) * fine / (1 - fine), order};
}

}  // namespace tabor::numerics
