#include "tabor/topography/gaussian.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "tabor/core/rows.hpp"

namespace tabor::topography {
namespace {

using std::numbers::pi;

/// Weights w_0, w_1, ... of ISO 16610-21: exp(-pi (x / (alpha lc))^2), alpha = sqrt(ln 2 / pi).
std::vector<double> gaussian_weights(double spacing, const Gaussian& gaussian) {
  const double alpha = std::sqrt(std::numbers::ln2 / pi);
  const bool mirrored = gaussian.beyond == Beyond::mirror_image;
  const double reach = gaussian.reach * gaussian.wavelength + (mirrored ? spacing / 2 : 0);
  std::vector<double> weights;
  for (Index k = 0; static_cast<double>(k) * spacing <= reach; ++k) {
    const double x = static_cast<double>(k) * spacing / (alpha * gaussian.wavelength);
    weights.push_back(std::exp(-pi * x * x));
  }
  return weights;
}

/// Pixel of the row that stands for position x beyond its ends.
Index inside(Index x, Index n, Beyond beyond) {
  const Index period = beyond == Beyond::mirror_image ? 2 * n : n;
  x = ((x % period) + period) % period;
  return x < n ? x : period - 1 - x;
}

/// Weighted sums along one row.
void smooth_row(double* row, Index n, const std::vector<double>& weights, Beyond beyond) {
  const bool open = beyond == Beyond::nothing;
  const Index reach = std::ssize(weights) - 1;
  const Index halo = open ? std::min(reach, n - 1) : reach;  // beyond n - 1 there is nothing to add
  Eigen::ArrayXd extended = Eigen::ArrayXd::Zero(n + 2 * halo);
  for (Index x = open ? 0 : -halo; x < (open ? n : n + halo); ++x) {
    extended[x + halo] = row[inside(x, n, beyond)];
  }
  Eigen::Map<Eigen::ArrayXd> result(row, n);
  result = weights[0] * extended.segment(halo, n);
  for (Index k = 1; k <= halo; ++k) {
    result += weights[static_cast<std::size_t>(k)] *
              (extended.segment(halo - k, n) + extended.segment(halo + k, n));
  }
}

/// A Gaussian along both axes, without normalisation.
Field smooth_both(Field field, const Grid& grid, const Gaussian& gaussian) {
  for (const double spacing : {grid.dx(), grid.dy()}) {
    const auto weights = gaussian_weights(spacing, gaussian);
    for_each_row(field.rows(), [&](Index y) {
      smooth_row(&field(y, 0), field.cols(), weights, gaussian.beyond);
    });
    field = Field(field.transpose());  // twice: back in the original order at the end
  }
  return field;
}

/// Without holes the sum of weights is a product of one factor per axis.
Eigen::ArrayXd weight_sums(Index n, double spacing, const Gaussian& gaussian) {
  Eigen::ArrayXd sums = Eigen::ArrayXd::Ones(n);
  smooth_row(sums.data(), n, gaussian_weights(spacing, gaussian), gaussian.beyond);
  return sums;
}

}  // namespace

Field gaussian_low_pass(const Field& height, const Grid& grid, const Gaussian& gaussian) {
  if (!height.hasNaN()) {
    Field smooth = smooth_both(height, grid, gaussian);
    smooth.rowwise() /= weight_sums(grid.nx, grid.dx(), gaussian).transpose();
    smooth.colwise() /= weight_sums(grid.ny, grid.dy(), gaussian);
    return smooth;
  }
  const auto missing = height.isNaN();
  Field smooth = smooth_both(missing.select(0, height), grid, gaussian);
  Field weight = 1 - missing.cast<double>();
  smooth /= smooth_both(std::move(weight), grid, gaussian);
  return missing.select(height, smooth);
}

}  // namespace tabor::topography
