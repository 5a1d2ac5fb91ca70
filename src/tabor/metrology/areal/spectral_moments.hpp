#pragma once

#include "tabor/topography/topography.hpp"

// Computes the spectral moments m0, m2 and m4 of a surface, from differences or from its spectrum.
namespace tabor::metrology {

/// Moments of the power spectrum: mean squares of height, slope and curvature. The isotropic ones
/// are those of a profile in any direction of an isotropic surface with the same gradient and
/// Laplacian (Longuet-Higgins 1957). NaN where the surface has too few points.
struct SpectralMoments {
  double m0 = 0;                      ///< [m^2]
  double m2_x = 0, m2_y = 0, m2 = 0;  ///< [1]; m2 isotropic
  double m4_x = 0, m4_y = 0, m4 = 0;  ///< [1/m^2]; m4 isotropic
};

/// Computes the moments from differences of neighbouring pixels: (z1 - z0)/dx and (z1 - 2 z0 +
/// z-1)/dx^2, pairs and triples that touch a hole left out. Throws InputError if all are holes.
SpectralMoments difference_moments(const topography::Topography& topography);

/// Computes the moments as sums of |F|^2 q^n over the discrete power spectrum, of the heights about
/// their mean times a Hann window along both axes (none if the surface is periodic), normalised so
/// that <z^2> is (2 pi)^-2 times the integral of C2D (Jacobs, Junge & Pastewka 2017). Needs a
/// surface without holes.
SpectralMoments spectrum_moments(const topography::Topography& topography);

}  // namespace tabor::metrology
