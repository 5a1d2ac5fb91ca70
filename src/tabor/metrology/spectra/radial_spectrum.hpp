#pragma once

#include "tabor/metrology/spectra/psd.hpp"

namespace tabor::metrology {

/// Computes C2D (Jacobs, Junge & Pastewka 2017) = |dx dy FFT2|^2 / (Lx Ly) of the heights about
/// their mean, averaged over rings up to the smaller Nyquist wavevector; rms height and slope from
/// all modes.
Spectrum radial_spectrum(const Field& height, const Grid& grid, PsdWindow window);

}  // namespace tabor::metrology
