#pragma once

#include <vector>

#include "tabor/core/mean.hpp"
#include "tabor/metrology/spectra/psd.hpp"

// Averages the power spectra of several surfaces.
namespace tabor::metrology {

/// Mean and scatter of the densities of several surfaces at each wavevector.
struct MeanSpectrum {
  std::vector<double> q;      ///< [rad/m], rising: where all of them are known
  std::vector<Mean> density;  ///< at each q, in `unit`
  std::string unit;
};

/// Computes the arithmetic mean: a density is a mean square per wavevector, so that the integral of
/// the mean density is the mean of the mean squares of the heights (Parseval); the mean of the
/// logarithms would be below it wherever the surfaces differ. Spectra of one axis of wavevectors
/// are taken as they are; others at the wavevectors of the coarsest one that all reach, between two
/// bins along the straight line in log C over log q, which is exact for a power law (beside a zero
/// in C over q). Throws InputError for spectra of different units, for none, and where no range is
/// common.
MeanSpectrum mean_spectrum(const std::vector<Spectrum>& spectra);

}  // namespace tabor::metrology
