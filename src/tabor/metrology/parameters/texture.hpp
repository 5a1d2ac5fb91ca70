#pragma once

#include "tabor/topography/topography.hpp"

namespace tabor::metrology {

/// What the Fourier transform of the heights about their mean says of the texture.
struct Texture {
  double direction = 0;   ///< [rad] of the strongest wavevectors, 0 = x, pi/2 = up, in [0, pi)
  double wavelength = 0;  ///< [m] of the largest Fourier magnitude
  Index n_holes = 0;      ///< pixels that counted as the mean
};

/// Angular power spectrum: the power |F(q)|^2 summed along rays of physical wavevectors, weighted
/// by q (ISO 25178-2), every half degree, bilinear between the modes. Both are NaN for a flat
/// surface, a single row or column has the direction of its axis. Single precision: 8 bytes per
/// pixel. No window: the ends of a scan that is not periodic add power along x and y.
Texture texture_of(const topography::Topography& topography);

}  // namespace tabor::metrology
