// Height parameters: moments and extremes of the valid heights.
#include <cmath>

#include "tabor/core/error.hpp"
#include "tabor/topography/parameters/height_moments.hpp"
#include "tabor/topography/parameters/sets.hpp"

namespace tabor::topography {
namespace {

double mean_of_valid(const Field& height, Index& n) {
  const auto sums = sum_over_rows<2>(height.rows(), [&](Index y) {
    Eigen::Array2d row = Eigen::Array2d::Zero();
    for (Index x = 0; x < height.cols(); ++x) {
      if (!std::isnan(height(y, x))) {
        row += Eigen::Array2d(height(y, x), 1);
      }
    }
    return row;
  });
  n = static_cast<Index>(sums[1]);
  if (n == 0) {
    throw InputError("surface parameters", "a surface of holes only", "some valid heights", "");
  }
  return sums[0] / sums[1];
}

/// Sums of d, |d|, d^2, d^3, d^4 with d = z - mean over one row.
Eigen::Array<double, 5, 1> row_powers(const Field& height, Index y, double mean) {
  Eigen::Array<double, 5, 1> sums = Eigen::Array<double, 5, 1>::Zero();
  for (Index x = 0; x < height.cols(); ++x) {
    const double d = height(y, x) - mean;
    if (!std::isnan(d)) {
      const double square = d * d;
      sums[0] += d;
      sums[1] += std::abs(d);
      sums[2] += square;
      sums[3] += square * d;
      sums[4] += square * square;
    }
  }
  return sums;
}

}  // namespace

HeightMoments height_moments(const Field& height) {
  HeightMoments m;
  m.mean = mean_of_valid(height, m.n);
  m.highest = height.maxCoeff<Eigen::PropagateNumbers>();
  m.lowest = height.minCoeff<Eigen::PropagateNumbers>();
  if (m.highest == m.lowest) {
    return {.n = m.n, .mean = m.highest};  // flat, whatever the rounding of the mean
  }
  const auto n = static_cast<double>(m.n);
  // One more pass for the mean: a scan 1 m above its datum keeps nanometres only this way.
  m.mean +=
      sum_over_rows<5>(height.rows(), [&](Index y) { return row_powers(height, y, m.mean); })[0] /
      n;
  const auto sums =
      sum_over_rows<5>(height.rows(), [&](Index y) { return row_powers(height, y, m.mean); });
  m.mean_abs = sums[1] / n;
  m.second = sums[2] / n;
  m.third = sums[3] / n;
  m.fourth = sums[4] / n;
  m.highest -= m.mean;
  m.lowest -= m.mean;
  return m;
}

double rms_height(const Topography& topography) {
  return std::sqrt(height_moments(topography.height).second);
}

std::vector<Parameter> height_parameters(const Topography& topography) {
  const HeightMoments m = height_moments(topography.height);
  const double sq = std::sqrt(m.second);
  const bool rough = sq > 0;
  const std::string about = "; z about the mean of the valid points";
  const std::string no_shape = rough ? "" : "a flat surface has none";
  return {
      {"N", static_cast<double>(m.n), "1", "valid points (pixels that are not holes)"},
      {"Sa", m.mean_abs, "m", "arithmetic mean height <|z|>" + about},
      {"Sq", sq, "m", "root mean square height sqrt(<z^2>), divided by N" + about},
      {"Ssk", rough ? m.third / (m.second * sq) : kNoValue, "1", "skewness <z^3>/Sq^3" + about,
       no_shape},
      {"Sku", rough ? m.fourth / (m.second * m.second) : kNoValue, "1",
       "kurtosis <z^4>/Sq^4 (3 for a Gaussian surface)" + about, no_shape},
      {"Sp", m.highest, "m", "highest peak max z" + about},
      {"Sv", -m.lowest, "m", "deepest pit -min z" + about},
      {"Sz", m.highest - m.lowest, "m", "maximum height Sp + Sv"},
  };
}

}  // namespace tabor::topography
