#pragma once

#include "tabor/core/types.hpp"

namespace tabor::topography {

/// Central moments of the valid heights, divided by their number.
struct HeightMoments {
  Index n = 0;
  double mean = 0;                           ///< [m]
  double mean_abs = 0;                       ///< <|z|> [m], z about the mean
  double second = 0, third = 0, fourth = 0;  ///< <z^2> [m^2], <z^3>, <z^4>
  double highest = 0, lowest = 0;            ///< about the mean [m]
};

/// Throws InputError if every pixel is a hole.
HeightMoments height_moments(const Field& height);

}  // namespace tabor::topography
