#pragma once

#include <vector>

namespace tabor::numerics {

/// What values tend to as the spacing goes to zero.
struct GridLimit {
  double value = 0;  ///< NaN where the values show no limit
  double order = 0;  ///< p of the error ~ spacing^p that they show; NaN with it, and of values that
                     ///< are all the same
};

/// Richardson's extrapolation from the three finest of at least three values: the order is the one
/// that the values show, not one that is believed. `spacing`: of the grid each belongs to, in any
/// unit and order, all different.
GridLimit limit_of(const std::vector<double>& spacing, const std::vector<double>& value);

}  // namespace tabor::numerics
