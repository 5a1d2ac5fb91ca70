#include "tabor/contact/trapped/pockets.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "tabor/contact/trapped/regions.hpp"

namespace tabor::contact {
namespace {

/// Marks the gap with a way out, pixel by pixel.
template <bool periodic>
std::vector<std::uint8_t> open_gap(const Mask& contact, const Grid& grid) {
  const bool* touching = contact.data();
  const auto is_gap = [touching](Index i) { return !touching[i]; };
  Regions<periodic> regions(grid, is_gap);
  std::vector<std::uint8_t> open(static_cast<std::size_t>(grid.size()), 0);
  for (Index i = 0; i < grid.size(); ++i) {
    open[static_cast<std::size_t>(i)] = is_gap(i) && regions.is_open(regions.root(i));
  }
  return open;
}

/// What is known of a region by its root.
struct Region {
  bool is_open = false;
  double liquid = 0;               // sum of film [m]
  std::int32_t label = kNoPocket;  // once it has one
};

template <bool periodic>
Pockets find(const Mask& contact, const Field& film, const Grid& grid) {
  const std::vector<std::uint8_t> open = open_gap<periodic>(contact, grid);
  const auto n = static_cast<std::size_t>(grid.size());
  const auto belongs = [&](Index i) { return !contact.data()[i] || film.data()[i] > 0; };
  numerics::DisjointSets<std::int32_t> sets(n);
  join_neighbours<periodic>(grid, belongs, [&sets](Index a, Index b, Cells) {
    sets.join(static_cast<std::int32_t>(a), static_cast<std::int32_t>(b));
  });
  std::vector<Region> regions(n);
  const auto region_of = [&](Index i) -> Region& {
    return regions[static_cast<std::size_t>(sets.root(static_cast<std::int32_t>(i)))];
  };
  for (Index i = 0; i < grid.size(); ++i) {
    if (!belongs(i)) continue;
    Region& region = region_of(i);
    region.is_open = region.is_open || open[static_cast<std::size_t>(i)] != 0;
    region.liquid += film.data()[i];
  }
  std::vector<std::int32_t> labels(n, kNoPocket);
  std::int32_t n_labels = 0;
  for (Index i = 0; i < grid.size(); ++i) {
    if (!belongs(i)) continue;
    Region& region = region_of(i);
    if (region.is_open || !(region.liquid > 0)) continue;
    if (region.label == kNoPocket) region.label = n_labels++;
    labels[static_cast<std::size_t>(i)] = region.label;
  }
  Pockets pockets = pockets_of(std::move(labels), contact, film);
  pockets.open = open;
  return pockets;
}

}  // namespace

Pockets pockets_of(std::vector<std::int32_t> labels, const Mask& contact, const Field& film) {
  Pockets pockets;
  const std::size_t n_labels =
      labels.empty()
          ? 0
          : static_cast<std::size_t>(*std::max_element(labels.begin(), labels.end()) + 1);
  pockets.first.assign(n_labels + 1, 0);
  pockets.volume.assign(n_labels, 0);
  pockets.open.assign(labels.size(), 0);
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (labels[i] == kNoPocket) {
      pockets.open_volume += film.data()[i];
      pockets.open[i] = !contact.data()[i];
      continue;
    }
    const auto pocket = static_cast<std::size_t>(labels[i]);
    ++pockets.first[pocket + 1];
    pockets.volume[pocket] += film.data()[i];
  }
  std::partial_sum(pockets.first.begin(), pockets.first.end(), pockets.first.begin());
  std::vector<std::size_t> next(pockets.first.begin(), pockets.first.end());
  pockets.pixels.resize(pockets.first.back());
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (labels[i] == kNoPocket) continue;
    pockets.pixels[next[static_cast<std::size_t>(labels[i])]++] = static_cast<std::uint32_t>(i);
  }
  pockets.of = std::move(labels);
  return pockets;
}

Pockets find_pockets(const Mask& contact, const Field& film, const Grid& grid, bool periodic) {
  return periodic ? find<true>(contact, film, grid) : find<false>(contact, film, grid);
}

}  // namespace tabor::contact
