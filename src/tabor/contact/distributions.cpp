#include "tabor/contact/distributions.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>

#include "tabor/contact/patches.hpp"

namespace tabor::contact {
namespace {

/// Equal bins over the values of the selected pixels.
Histogram equal_bins(const Field& field, const Mask& selected, int n_bins) {
  Histogram histogram;
  const double largest = selected.any() ? selected.select(field, 0.0).maxCoeff() : 0.0;
  for (int k = 0; k <= n_bins; ++k) histogram.edges.push_back(largest * k / n_bins);
  histogram.counts.assign(static_cast<std::size_t>(n_bins), 0);
  for (Index i = 0; i < field.size(); ++i) {  // raw loop: many pixels add to one count
    if (selected(i)) {
      const double position = largest > 0 ? field(i) / largest * n_bins : 0;
      histogram.counts[static_cast<std::size_t>(
          std::clamp(static_cast<int>(position), 0, n_bins - 1))] += 1;
    }
  }
  return histogram;
}

}  // namespace

Histogram pressure_histogram(const State& state, int n_bins) {
  return equal_bins(state.pressure, contact_mask(state), n_bins);
}

Histogram gap_histogram(const State& state, int n_bins) {
  return equal_bins(state.gap, !contact_mask(state), n_bins);
}

Histogram patch_area_histogram(const State& state, const Grid& grid, bool periodic) {
  const Patches patches = find_patches(contact_mask(state), periodic);
  Histogram histogram;
  for (const Index n_pixels : patches.pixel_counts) {
    const auto bin =
        static_cast<std::size_t>(std::bit_width(static_cast<std::uint64_t>(n_pixels))) - 1;
    histogram.counts.resize(std::max(histogram.counts.size(), bin + 1), 0);
    histogram.counts[bin] += 1;
  }
  for (std::size_t k = 0; k <= histogram.counts.size(); ++k) {  // raw loop: edges, one per bin
    histogram.edges.push_back(grid.pixel_area() * static_cast<double>(std::uint64_t{1} << k));
  }
  return histogram;
}

}  // namespace tabor::contact
