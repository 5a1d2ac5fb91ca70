#pragma once

#include <string>
#include <string_view>

#include "tabor/topography/topography.hpp"

// Filters surfaces by low-pass and high-pass filters (Hann, Gaussian of ISO 16610-61).
namespace tabor::topography {

/// Transfer functions of a low-pass filter; k in cycles per metre, kc the cutoff.
/// hann:           0.5 (1 + cos(pi k/kc)), k = |k|, 0 beyond kc (radial)
/// hann_full:      the same with kc/2: the full width of the window is kc
/// hann_separable: the product of both axes' windows
/// gauss:          ISO 16610-61, 50 % at the cutoff wavelength; weights renormalised over valid
/// points (regression of order 0), at edges as around holes
/// gauss_reflect:  the same curve as image processing applies it: heights mirrored beyond the edges
///                 (d c b a | a b c d), weights cut at 4 standard deviations
enum class FilterKind { hann, hann_full, hann_separable, gauss, gauss_reflect };

/// Low-pass filter and its cutoff: either a wavelength or a count of cycles per scan side.
struct Filter {
  FilterKind kind = FilterKind::hann;
  double wavelength = 0;       ///< [m], cutoff wavelength; 0 = see cycles_per_side
  double cycles_per_side = 0;  ///< "512/L": cutoff = cycles_per_side / L, L = sqrt(lx ly)

  /// Returns the cutoff wavelength [m] on a scan of this side [m].
  double cutoff_wavelength(double side) const {
    return wavelength > 0 ? wavelength : side / cycles_per_side;
  }
};

/// Parses "hann:512/L", "hann-full:512/L", "hann-separable:512/L", "hann:8um", "hann:1/(8um)",
/// "gauss:8um". Throws InputError naming the nearest kind. `step` is how the user wrote it
/// ("lowpass").
Filter parse_filter(std::string_view text, std::string_view step = "lowpass");
std::string to_string(const Filter& filter);

/// Returns the side L that "512/L" refers to: sqrt(lx ly), the side of a square scan of the same
/// area, so that the number of Fourier modes below the cutoff does not depend on the shape of the
/// scan.
double scan_side(const Grid& grid);

/// Returns the side L of one copy of the scan where mirror() has made more of it: the L of every
/// filter.
double filter_side(const Topography& topography);

/// Returns the smoothed heights. Hann windows act on the discrete Fourier transform and need a
/// field without holes (InputError naming `--fill harmonic`); the Gaussian keeps holes as holes
/// without weight and wraps round only where `periodic`. Throws InputError for a cutoff of more
/// than 100 scan sides.
Field low_pass(const Field& height, const Grid& grid, const Filter& filter, double side,
               bool periodic);

/// Apply a low-pass (S-filter) or its complement z - low-pass (L-filter), with a line in the
/// history, and a warning where the cutoff is longer than the scan or too short to change anything.
/// The L of "512/L" is filter_side(topography).
Topography low_pass(Topography topography, const Filter& filter);
Topography high_pass(Topography topography, const Filter& filter);

}  // namespace tabor::topography
