#pragma once

#include <vector>

#include "tabor/core/convergence.hpp"
#include "tabor/core/types.hpp"

// Computes mean square height differences against the distance of points (structure function).
namespace tabor::metrology {

/// Mean square height difference (structure function) of points a lag apart.
struct HeightDifference {
  std::vector<double> lag;          ///< [m], rising, from one pixel
  std::vector<double> mean_square;  ///< [m^2], <(z(r + lag) - z(r))^2> over valid pairs
  std::vector<double> pairs;        ///< how many pairs; lags without any are left out
};

/// Mean square height differences along x, along y and in all directions.
struct HeightDifferences {
  HeightDifference x;       ///< along rows, all lags
  HeightDifference y;       ///< along columns, all lags
  HeightDifference radial;  ///< every pair of the ring (k - 1/2, k + 1/2) w counts the same;
                            ///< w = larger pixel side, lag = mean distance of the pairs, up to the
                            ///< shorter side of the scan; none of a profile
};

/// Computes exact sums over all pairs of valid points, from correlations in double precision; needs
/// about 4 bytes per pixel beside the heights. Differences cancel to about 1e-14 of the mean square
/// height. Throws InputError without a valid height.
HeightDifferences height_differences(const Field& height, const Grid& grid,
                                     const Observer& observer = {});

}  // namespace tabor::metrology
