#include "tabor/contact/trapped/pockets.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "tabor/contact/trapped/regions.hpp"

namespace tabor::contact {
namespace {

/// Marks the gap with a way out, pixel by pixel.
template <elastic::Border border>
std::vector<std::uint8_t> open_gap(const Mask& contact, const Grid& grid) {
  const bool* touching = contact.data();
  Regions<border> regions(grid, [touching](Index i) { return !touching[i]; });
  const numerics::Runs& runs = regions.runs();
  std::vector<std::uint8_t> is_open(runs.size());
  for (std::size_t run = 0; run < runs.size(); ++run) {
    is_open[run] = regions.is_open(regions.root(run));
  }
  std::vector<std::uint8_t> open(static_cast<std::size_t>(grid.size()), 0);
  for_each(runs.size(), [&](std::size_t run) {
    std::fill(open.begin() + runs[run].begin, open.begin() + runs[run].end, is_open[run]);
  });
  return open;
}

/// What is known of a run, then of its region by the first of its runs.
struct Region {
  bool is_open = false;
  double liquid = 0;               // sum of film [m]
  std::int32_t label = kNoPocket;  // once it has one
};

/// Pocket of each run of pixels without contact or with liquid, or kNoPocket.
std::vector<std::int32_t> labels_of(const numerics::Runs& runs, bool periodic,
                                    std::vector<Region>& regions) {
  numerics::DisjointSets<std::int32_t> sets(runs.size());
  runs.join_neighbours(periodic, [&sets](std::size_t a, std::size_t b, int, int) {
    sets.join(static_cast<std::int32_t>(a), static_cast<std::int32_t>(b));
  });
  const auto region_of = [&](std::size_t run) -> Region& {
    return regions[static_cast<std::size_t>(sets.root(static_cast<std::int32_t>(run)))];
  };
  for (std::size_t run = 0; run < runs.size(); ++run) {
    Region& region = region_of(run);
    if (&region == &regions[run]) continue;
    region.is_open = region.is_open || regions[run].is_open;
    region.liquid += regions[run].liquid;
  }
  std::vector<std::int32_t> labels(runs.size(), kNoPocket);
  std::int32_t n_labels = 0;
  for (std::size_t run = 0; run < runs.size(); ++run) {
    Region& region = region_of(run);
    if (region.is_open || !(region.liquid > 0)) continue;
    if (region.label == kNoPocket) region.label = n_labels++;
    labels[run] = region.label;
  }
  return labels;
}

/// Copies of each pocket of one image in the map of 2 x 2: a pocket at a seam is one with its
/// mirror image there.
std::vector<int> copies_of(const Pockets& pockets, const Grid& grid) {
  std::vector<int> copies(pockets.size());
  for (std::size_t k = 0; k < copies.size(); ++k) {
    bool is_at_x_seam = false;
    bool is_at_y_seam = false;
    for (std::size_t j = pockets.first[k]; j < pockets.first[k + 1]; ++j) {
      const Index x = pockets.pixels[j] % grid.nx;
      const Index y = pockets.pixels[j] / grid.nx;
      is_at_x_seam = is_at_x_seam || x == 0 || x + 1 == grid.nx;
      is_at_y_seam = is_at_y_seam || y == 0 || y + 1 == grid.ny;
    }
    copies[k] = (is_at_x_seam ? 1 : 2) * (is_at_y_seam ? 1 : 2);
  }
  return copies;
}

template <elastic::Border border>
Pockets find(const Mask& contact, const Field& film, const Grid& grid) {
  std::vector<std::uint8_t> open = open_gap<border>(contact, grid);
  const bool* touching = contact.data();
  const double* liquid = film.data();
  const numerics::Runs runs(grid.ny, grid.nx,
                            [=](Index i) { return !touching[i] || liquid[i] > 0; });
  std::vector<Region> regions(runs.size());
  for_each(runs.size(), [&](std::size_t run) {
    for (Index i = runs[run].begin; i < runs[run].end; ++i) {
      regions[run].is_open = regions[run].is_open || open[static_cast<std::size_t>(i)] != 0;
      regions[run].liquid += liquid[i];
    }
  });
  const std::vector<std::int32_t> of_runs =
      labels_of(runs, border == elastic::Border::repeats, regions);
  std::vector<std::int32_t> labels(static_cast<std::size_t>(grid.size()), kNoPocket);
  for_each(runs.size(), [&](std::size_t run) {
    std::fill(labels.begin() + runs[run].begin, labels.begin() + runs[run].end, of_runs[run]);
  });
  Pockets pockets = pockets_of(std::move(labels), contact, film);
  pockets.open = std::move(open);
  if (border == elastic::Border::mirrors) pockets.copies = copies_of(pockets, grid);
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
  pockets.copies.assign(n_labels, 1);
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

Pockets find_pockets(const Mask& contact, const Field& film, const Grid& grid,
                     elastic::Border border) {
  using elastic::Border;
  if (border == Border::repeats) return find<Border::repeats>(contact, film, grid);
  return border == Border::mirrors ? find<Border::mirrors>(contact, film, grid)
                                   : find<Border::ends>(contact, film, grid);
}

}  // namespace tabor::contact
