#pragma once

#include "tabor/core/types.hpp"

// Computes moments of heights and the padding that sums over pairs of points need.
namespace tabor::metrology {

/// Number, mean [m] and mean square about the mean [m^2] of the valid heights.
struct Moments {
  double n = 0;
  double mean = 0;
  double mean_square = 0;
};

/// Computes the moments of the valid heights. Throws InputError without a valid height.
Moments moments_of(const Field& height);

/// Returns the number of points of a transform in which shifts of up to n - 1 pixels do not wrap
/// round.
Index padded_for_lags(Index n);

}  // namespace tabor::metrology
