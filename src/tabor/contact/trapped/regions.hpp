#pragma once

#include <cstdint>
#include <type_traits>
#include <vector>

#include "tabor/core/types.hpp"
#include "tabor/numerics/disjoint_sets.hpp"

// Connects pixels of a map to regions and finds those that reach its border or run through it.
namespace tabor::contact {

/// Periodic cells from one place to another.
struct Cells {
  std::int32_t x = 0;
  std::int32_t y = 0;
  Cells operator+(Cells o) const { return {x + o.x, y + o.y}; }
  Cells operator-(Cells o) const { return {x - o.x, y - o.y}; }
  bool operator==(const Cells&) const = default;
};

/// Calls join(pixel, neighbour, cells) for each pair of neighbours of the map that both belong:
/// right and below of each pixel. `cells`: periodic cells from the first to the second.
template <bool periodic, typename Belongs, typename Join>
void join_neighbours(const Grid& grid, const Belongs& belongs, const Join& join) {
  for (Index row = 0; row < grid.ny; ++row) {
    const bool last_row = row + 1 == grid.ny;
    const Index below = last_row ? 0 : row + 1;
    for (Index column = 0; column < grid.nx; ++column) {
      const Index pixel = row * grid.nx + column;
      if (!belongs(pixel)) continue;
      const bool last_column = column + 1 == grid.nx;
      const Index right = row * grid.nx + (last_column ? 0 : column + 1);
      if ((periodic || !last_column) && belongs(right)) {
        join(pixel, right, Cells{last_column ? 1 : 0, 0});
      }
      const Index under = below * grid.nx + column;
      if ((periodic || !last_row) && belongs(under)) join(pixel, under, Cells{0, last_row ? 1 : 0});
    }
  }
}

/// Regions of pixels connected by their four neighbours, known by their first pixels. A region is
/// open where it reaches the border of the map; in a periodic cell there is no border: there it
/// must connect a point with its own periodic image. Sets have offsets in a periodic cell: two
/// paths to one pixel that differ by whole cells show that a region runs through the cell (Newman &
/// Ziff 2001, doi:10.1103/PhysRevE.64.016706).
template <bool periodic>
class Regions {
 public:
  /// belongs(pixel): the pixel is in a region.
  template <typename Belongs>
  Regions(const Grid& grid, const Belongs& belongs)
      : sets_(static_cast<std::size_t>(grid.size())),
        open_(static_cast<std::size_t>(grid.size()), 0) {
    if constexpr (!periodic) mark_border(grid, belongs);
    join_neighbours<periodic>(grid, belongs,
                              [this](Index a, Index b, Cells cells) { join(a, b, cells); });
  }

  Index root(Index pixel) { return sets_.root(static_cast<std::int32_t>(pixel)); }
  bool is_open(Index root_pixel) const { return open_[static_cast<std::size_t>(root_pixel)] != 0; }

 private:
  using Offset = std::conditional_t<periodic, Cells, numerics::NoOffset>;

  static Offset offset_of(Cells cells) {
    if constexpr (periodic) return cells;
    return {};
  }

  template <typename Belongs>
  void mark_border(const Grid& grid, const Belongs& belongs) {
    const auto mark = [&](Index pixel) {
      if (belongs(pixel)) open_[static_cast<std::size_t>(pixel)] = 1;
    };
    for (Index x = 0; x < grid.nx; ++x) mark(x), mark((grid.ny - 1) * grid.nx + x);
    for (Index y = 0; y < grid.ny; ++y) mark(y * grid.nx), mark(y * grid.nx + grid.nx - 1);
  }

  void join(Index a, Index b, Cells cells) {
    const bool open = is_open(root(a)) || is_open(root(b));
    const auto joined =
        sets_.join(static_cast<std::int32_t>(a), static_cast<std::int32_t>(b), offset_of(cells));
    const bool runs_through = joined.were_one && !(joined.difference == Offset{});
    open_[static_cast<std::size_t>(joined.root)] = open || runs_through;
  }

  numerics::DisjointSets<std::int32_t, Offset> sets_;
  std::vector<std::uint8_t> open_;  // of roots: there is a way out
};

}  // namespace tabor::contact
