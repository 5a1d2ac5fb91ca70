#pragma once

#include <vector>

// Extrapolates values of several grids to zero spacing (Richardson) and finds the order of
// convergence.
namespace tabor::numerics {

/// Limit of values as the spacing goes to zero.
struct GridLimit {
  double value = 0;  ///< NaN where the values show no limit
  double order = 0;  ///< p of the error ~ spacing^p that they show; NaN with it, and of values that
                     ///< are all the same
};

/// Extrapolates (Richardson) from the three finest of at least three values; the order is measured
/// from the values, not assumed. `spacing` of the grid of each value: in any unit and order, all
/// different.
GridLimit limit_of(const std::vector<double>& spacing, const std::vector<double>& value);

}  // namespace tabor::numerics
