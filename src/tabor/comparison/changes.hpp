#pragma once

#include "tabor/core/types.hpp"

// Finds the places where two scans of one surface differ by more than their noise.
namespace tabor::comparison {

/// Masks of the changes in a map of losses, and the noise of the other places.
struct Changes {
  Mask worn;             ///< with the rims that the threshold does not show
  Mask piled_up;         ///< the same of negative losses
  Mask quiet;            ///< valid heights beyond both
  double noise = 0;      ///< [m], robust standard deviation of the loss at quiet places
  double threshold = 0;  ///< [m], on the smoothed loss
  double floor = 0;      ///< [m] per pixel that noise alone adds to either side
};

/// Returns the number of pixels that vary together in the loss at quiet places.
double correlated_pixels(const Field& loss, const Grid& grid, const Mask& quiet);

/// Finds changes: where the loss smoothed by a Gaussian of cutoff 5 pixels exceeds `threshold`
/// times its noise, and what lies around them, ring of pixels by ring, until the mean of the next
/// four rings is not above zero: a rim too shallow to be seen pixel by pixel is seen in the mean
/// over all of it. There is a rim where the mean of the first four rings is above twice its error,
/// beyond what noise has around places that it lifted above the threshold. Each pixel belongs to
/// the nearest change. Noise is taken as `resolution` [m] at least, what the heights resolve: below
/// it a difference is one of rounding.
Changes find_changes(const Field& loss, const Grid& grid, double threshold, double resolution);

}  // namespace tabor::comparison
