#pragma once

#include <cstdint>
#include <functional>

#include "tabor/core/types.hpp"

// Draws a periodic random field with a given power spectrum.
namespace tabor::synthesis {

/// Modulus of a wavevector on the ellipse of a surface whose features are `stretch` times longer
/// along x than along y; the area of the ellipse is that of the circle.
double elliptic_wavevector(double qx, double qy, double stretch);

/// A periodic random field with a given power spectrum.
struct RandomFieldRecipe {
  Grid grid;
  double stretch = 1;
  bool random_amplitudes = false;
  std::uint64_t seed = 1;
  std::uint64_t stream = 0;
  std::function<double(double q)> power;  ///< power of a mode at elliptic wavevector q, >= 0
};

struct RandomField {
  Field height;               ///< zero mean, not normalised
  double variance = 0;        ///< of height, from the spectrum
  double slope_variance = 0;  ///< of its gradient, spectral derivative
};

/// Each mode is drawn from (seed, stream, wavevector) alone. Nyquist modes are left out, since they
/// cannot carry a free phase.
RandomField random_field(const RandomFieldRecipe& recipe);

}  // namespace tabor::synthesis
