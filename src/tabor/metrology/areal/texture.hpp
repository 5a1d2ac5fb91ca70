#pragma once

#include "tabor/topography/topography.hpp"

// Finds the texture direction (Std) and the dominant wavelength of a surface.
namespace tabor::metrology {

/// Texture of a surface, from the Fourier transform of the heights about their mean.
struct Texture {
  double direction = 0;    ///< [rad] of the strongest wavevectors, 0 = x, pi/2 = up, in [0, pi)
  double wavelength = 0;   ///< [m] of the largest Fourier magnitude
  Index n_holes = 0;       ///< pixels that counted as the mean
  double uncertainty = 0;  ///< [rad] of the direction, from how far the modes there lie apart
  bool is_narrow = false;  ///< the field's shorter side leaves the direction open; then it is NaN
};

/// Finds the texture from the angular power spectrum: the power |F(q)|^2 per angle, which is that
/// along rays of physical wavevectors weighted by q (ISO 25178-2), every half degree. The power of
/// each mode is spread evenly to both sides, up to the angle of the next modes across: spread over
/// wavevectors it would be drawn to larger angles where they lie far apart (a strip). The direction
/// is known to half of that angle, or better where next to no power is beside it; NaN if the
/// shorter side of a strip alone makes that more than 10 degrees. Both are NaN for a flat surface,
/// a single row or column has the direction of its axis. Single precision: 8 bytes per pixel. No
/// window: the ends of a scan that is not periodic add power along x and y.
Texture texture_of(const topography::Topography& topography);

}  // namespace tabor::metrology
