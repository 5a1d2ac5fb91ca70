#pragma once

#include <vector>

#include "tabor/contact/contact.hpp"

namespace tabor::contact {

/// Counts between consecutive edges; the last bin includes its upper edge.
struct Histogram {
  std::vector<double> edges;  ///< one more than counts
  std::vector<Index> counts;
};

/// Pressures of the contact pixels [Pa], equal bins from 0 to the largest.
Histogram pressure_histogram(const State& state, int n_bins = 50);

/// Gaps of the pixels out of contact [m], equal bins from 0 to the largest.
Histogram gap_histogram(const State& state, int n_bins = 50);

/// Areas of the contact patches [m^2], each bin twice as wide as the one before, from one pixel up.
Histogram patch_area_histogram(const State& state, const Grid& grid, bool periodic);

}  // namespace tabor::contact
