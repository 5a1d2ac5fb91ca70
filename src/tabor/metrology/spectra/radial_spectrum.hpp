#pragma once

#include "tabor/metrology/spectra/psd.hpp"

namespace tabor::metrology {

struct RadialSpectrum {
  Spectrum spectrum;
  double window_gain = 1;  ///< mean square of the heights with the window over that without
};

/// Computes C2D (Jacobs, Junge & Pastewka 2017) = |dx dy FFT2|^2 / (Lx Ly) of the heights about
/// their mean, averaged over rings up to the smaller Nyquist wavevector; rms height and slope from
/// all modes.
RadialSpectrum radial_spectrum(const Field& height, const Grid& grid, PsdWindow window);

}  // namespace tabor::metrology
