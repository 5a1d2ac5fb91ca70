#pragma once

#include <string_view>

#include "tabor/topography/topography.hpp"

// Finds single heights that stand off from their surroundings, and removes them.
namespace tabor::topography {

/// Definition of a spike, and its replacement. A height is a spike when it lies further from the
/// median of the window around it than `threshold` times BOTH the spread in that window and the
/// typical distance from such a median all over the scan (of up to 131072 pixels). Spreads are
/// robust: 1.4826 times the median absolute deviation, the standard deviation of a Gaussian. Steps
/// and steep flanks have a wide spread of their own and stay; so do spikes that fill more than half
/// of a window.
struct SpikeRule {
  double threshold = 8;           ///< in standard deviations; why: docs/filters_and_spectra.md
  Index window = 5;               ///< pixels along x and y, odd; of a profile: on either side
  bool fill_with_median = false;  ///< else spikes become holes
};

/// Parses "auto", "8", "8,7", "8,7,median": threshold, window and replacement. Throws InputError.
SpikeRule parse_spike_rule(std::string_view text);

/// Returns true where a valid height is a spike. Heights with fewer than 5 valid neighbours are
/// none.
Mask find_spikes(const Field& height, const SpikeRule& rule = {});

/// Counts the spikes without memory per pixel, as for the inspection of a large scan.
Index count_spikes(const Field& height, const SpikeRule& rule = {});

/// Removes spikes; their number is in the history and, if any, among the warnings. The result is
/// searched again, also with wider windows: a warning reports spikes that stand together and names
/// the further pass that removes them, if one does that without removing more elsewhere.
Topography remove_spikes(Topography topography, const SpikeRule& rule = {});

}  // namespace tabor::topography
