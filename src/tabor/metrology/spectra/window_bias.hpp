#pragma once

#include <vector>

#include "tabor/metrology/spectra/psd.hpp"

// Computes what a window adds to the power spectrum of a power law. A window adds to the power of
// each mode some of its neighbours', which is much where a steep spectrum begins: the Hann window
// makes 1.7 times the power of the second mode of a profile with H = 0.8. Both functions return, at
// the wavevectors of a spectrum, the log of the expected density of a surface with the power
// q^-exponent (constant below roll_off, none at q = 0) over q^-exponent.
namespace tabor::metrology {

/// Returns the bias of lines of that length under the one-dimensional Hann window.
std::vector<double> line_bias(const std::vector<double>& q, double length, double roll_off,
                              double exponent);

/// Returns the bias of rings around q = 0, with or without the radial Hann window; 0 from the 25th
/// ring on.
std::vector<double> ring_bias(const std::vector<double>& q, const Grid& grid, PsdWindow window,
                              double roll_off, double exponent);

}  // namespace tabor::metrology
