#pragma once

#include <vector>

#include "tabor/contact/contact.hpp"

// Makes histograms of contact pressure, gap and the areas of contact patches.
namespace tabor::contact {

/// Histogram with counts between consecutive edges; the last bin includes its upper edge.
struct Histogram {
  std::vector<double> edges;  ///< one more than counts
  std::vector<Index> counts;
};

/// Counts the pressures of the contact pixels [Pa], in equal bins from 0 to the largest.
Histogram pressure_histogram(const State& state, int n_bins = 50);

/// Counts the gaps of the pixels out of contact [m], in equal bins from 0 to the largest.
Histogram gap_histogram(const State& state, int n_bins = 50);

/// Counts the areas of the contact patches [m^2]; each bin is twice as wide as the one before, from
/// one pixel up.
Histogram patch_area_histogram(const State& state, const Grid& grid, bool periodic);

}  // namespace tabor::contact
