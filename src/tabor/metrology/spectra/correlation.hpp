#pragma once

#include <algorithm>
#include <complex>
#include <cstdint>
#include <optional>
#include <vector>

#include "tabor/core/types.hpp"

// Computes the areal autocorrelation of heights and the correlation lengths Sal and Str.
namespace tabor::metrology {

/// Areal autocorrelation of heights about their mean, normalised at zero lag, unbiased: the mean
/// product over all pairs of valid points (lx, ly) pixels apart (ISO 25178-2 writes the integral;
/// dividing by the pairs instead of the area keeps far lags and holes from lowering it). Pairs do
/// not wrap round, not even on a periodic surface.
///
/// Lags |lx| < nx, |ly| < ny. Values are computed in single precision: errors are near 1e-7 times
/// all pairs over the pairs of that lag, so that lags of a few pairs (the corners) mean nothing in
/// any case.
class Autocorrelation {
 public:
  /// Returns the grid of the lags.
  const Grid& grid() const { return grid_; }
  double mean_square() const { return mean_square_; }  ///< [m^2], about the mean; 0 for a flat

  /// Returns the autocorrelation at a shift of lx columns and ly rows; NaN beyond the field or
  /// without a pair of valid points.
  double operator()(Index ly, Index lx) const;
  /// Interpolates bilinearly between lags; x, y in metres, of any sign.
  double at(double y, double x) const;

 private:
  friend Autocorrelation autocorrelation(const Field& height, const Grid& grid);

  Grid grid_;
  double mean_square_ = 0;
  Index row_length_ = 0;  ///< floats of a stored row; negative lx are counted from padded_nx_
  Index padded_nx_ = 0;
  std::vector<std::complex<float>> values_;  ///< pairs of floats: rows ly = 0 .. ny-1
};

/// Computes the autocorrelation of the valid heights about their mean. Level before: a tilt never
/// decays. Takes 8 bytes per pixel beside the heights (12 with holes). Throws InputError without a
/// valid height.
Autocorrelation autocorrelation(const Field& height, const Grid& grid);

/// Distances at which the autocorrelation first falls to a threshold along rays from zero lag.
struct CorrelationLengths {
  double shortest = 0;            ///< Sal [m]; NaN if no ray falls to the threshold
  double shortest_angle = 0;      ///< [rad], 0 = along x, turning from x to the next rows
  std::optional<double> longest;  ///< [m]; none if some ray leaves the field above the threshold
  double longest_angle = 0;       ///< [rad], of `longest`, or of the ray that went furthest
  double reach = 0;               ///< [m], how far that ray could be followed; `longest` if found
  Index n_unfinished_rays = 0;    ///< rays that left the field above the threshold

  /// Returns Str = Sal / longest; none where it is only known to be below `texture_bound`.
  std::optional<double> texture_aspect() const;
  double texture_bound() const {
    return std::min(1.0, shortest / reach);
  }  ///< Str is smaller than this
};

/// Finds Sal and Str of ISO 25178-2 along rays every 0.25 degrees, followed in steps of half a
/// pixel with bilinear interpolation, to the first crossing of `threshold`.
CorrelationLengths correlation_lengths(const Autocorrelation& acf, double threshold = 0.2);

}  // namespace tabor::metrology
