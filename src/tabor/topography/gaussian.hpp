#pragma once

#include "tabor/topography/topography.hpp"

// Smooths heights by a Gaussian filter, with a choice of what lies beyond the edges.
namespace tabor::topography {

/// Continuation of a row beyond its ends.
enum class Beyond { nothing, row_again, mirror_image };

/// Gaussian filter: its wavelength, the continuation beyond the edges, and where its weights end
/// [cutoff wavelengths].
struct Gaussian {
  double wavelength = 0;  ///< [m]
  Beyond beyond = Beyond::nothing;
  double reach = 1.35;  ///< there weights are 1e-11 of the largest; mirrored: to the next pixel
};

/// Standard deviation over cutoff wavelength, sqrt(ln 2 / 2) / pi.
inline constexpr double kSigmaOfCutoff = 0.1873906251292776;

/// Returns heights smoothed by a Gaussian of ISO 16610-61, 50 % at the cutoff wavelength: weighted
/// means over the valid heights within reach. Holes stay holes.
Field gaussian_low_pass(const Field& height, const Grid& grid, const Gaussian& gaussian);

}  // namespace tabor::topography
