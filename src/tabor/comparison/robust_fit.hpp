#pragma once

#include <cmath>

#include "tabor/comparison/registration.hpp"
#include "tabor/core/rows.hpp"
#include "tabor/numerics/small_matrices.hpp"

// Fits planes and other linear models by least squares with Tukey's biweight, which ignores
// outliers.
namespace tabor::comparison {

/// Returns 1.4826 times the median distance of the valid heights from their median: the standard
/// deviation of a Gaussian. NaN without a valid height.
double robust_spread(const Field& height);

/// Normal equations of a weighted least-squares fit of N unknowns.
template <int N>
struct NormalEquations {
  Eigen::Matrix<double, N, N> matrix;
  Eigen::Matrix<double, N, 1> right_side;
  double n_points = 0;  ///< with any weight

  /// Returns the solution; zero along directions that the points do not determine.
  Eigen::Matrix<double, N, 1> solution() const {
    return numerics::determined_inverse(matrix) * right_side;
  }
};

/// Returns the weight of a residual by Tukey's biweight; 1 without a cutoff.
inline double biweight(double residual, double cutoff) {
  if (!(cutoff > 0)) return 1;
  const double t = residual / cutoff;
  return std::abs(t) < 1 ? (1 - t * t) * (1 - t * t) : 0;
}

/// Cutoff of Tukey's biweight in standard deviations, and its efficiency on Gaussian residuals:
/// the variance of a least-squares fit over that of the biweight.
inline constexpr double kBiweightReach = 4.685;
inline constexpr double kBiweightEfficiency = 0.95;

/// Sums the normal equations of a fit. columns(y, x) is the row of the design matrix at a pixel;
/// NaN there or in `residual` leaves the pixel out. Weights are those of `residual`, which is
/// fitted by columns * solution.
template <int N, typename Columns>
NormalEquations<N> normal_equations(const Field& residual, double cutoff, const Columns& columns) {
  constexpr int n_sums = N * N + N + 1;
  const auto sums = sum_over_rows<n_sums>(residual.rows(), [&](Index y) {
    Eigen::Array<double, n_sums, 1> row = Eigen::Array<double, n_sums, 1>::Zero();
    for (Index x = 0; x < residual.cols(); ++x) {
      const double r = residual(y, x);
      const Eigen::Matrix<double, N, 1> j = columns(y, x);
      const double weight = biweight(r, cutoff);
      if (!std::isnan(r + j.sum()) && weight > 0) {
        Eigen::Map<Eigen::Matrix<double, N, N>>(row.data()) += weight * j * j.transpose();
        Eigen::Map<Eigen::Matrix<double, N, 1>>(row.data() + N * N) += weight * r * j;
        row[n_sums - 1] += 1;
      }
    }
    return row;
  });
  return {Eigen::Map<const Eigen::Matrix<double, N, N>>(sums.data()),
          Eigen::Map<const Eigen::Matrix<double, N, 1>>(sums.data() + N * N), sums[n_sums - 1]};
}

/// Fits a plane by Tukey's biweight (kBiweightReach robust standard deviations), so that outliers
/// do not count. Throws InputError with fewer than 9 valid heights.
RobustPlane fit_robust_plane(const Field& height);
Field remove_plane(const Field& height, const RobustPlane& plane);

/// Returns the coordinate of pixel i of n, from -1 to 1.
inline double across(Index i, Index n) {
  return (2 * static_cast<double>(i) + 1) / static_cast<double>(n) - 1;
}

}  // namespace tabor::comparison
