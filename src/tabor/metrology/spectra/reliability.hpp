#pragma once

#include <optional>

#include "tabor/core/types.hpp"

// Estimates the wavelengths at which a spectrum can be trusted, from pixel, scan size and tip
// radius.
namespace tabor::metrology {

/// Returns the largest scale at which a probing tip of the given radius [m] distorts the scan: the
/// largest distance 2 d between the outer two of three heights along x or y whose second difference
/// (z(r - d) - 2 z(r) + z(r + d)) / d^2 falls below -1/(2 R) anywhere (Sanner, Noehring, Thimons,
/// Jacobs & Pastewka 2022, Appl. Surf. Sci. Adv. 7:100190, doi:10.1016/j.apsadv.2021.100190; the
/// factor 1/2 is theirs, from simulated tips). A tip leaves no peak sharper than itself, so that
/// peaks as sharp as that are its own shape. Triples with a hole are left out. Returns 0 where even
/// neighbouring pixels are blunter: the pixel limits the scan, not the tip. Single high pixels
/// (spikes) look like sharp peaks: remove them first. Throws InputError for a radius that is not
/// positive.
double tip_limited_wavelength(const Field& height, const Grid& grid, double tip_radius);

/// Wavelengths between which a spectrum can be trusted.
struct TrustedRange {
  double shortest = 0;  ///< [m], four of the larger pixels, or what the tip allows
  double longest = 0;   ///< [m], a quarter of the shorter side
  bool tip_limits = false;
};

/// Returns the trusted range. Lower end: a wave shorter than four pixels is damped by the pixel's
/// own size and by the instrument, and waves beyond Nyquist (two pixels) are folded onto it. Upper
/// end: there are few waves longer than a quarter of the side, and levelling and the window act on
/// them. Both ends are rules of thumb, and are called so wherever they are printed.
TrustedRange trusted_range(const Field& height, const Grid& grid,
                           std::optional<double> tip_radius = {});

}  // namespace tabor::metrology
