#pragma once

#include <cstdint>
#include <type_traits>
#include <vector>

#include "tabor/core/types.hpp"
#include "tabor/numerics/disjoint_sets.hpp"
#include "tabor/numerics/runs.hpp"

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

/// Regions of pixels connected by their four neighbours, known by their first runs. A region is
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
      : runs_(grid.ny, grid.nx, belongs), sets_(runs_.size()), open_(runs_.size(), 0) {
    if constexpr (!periodic) {
      for (std::size_t run = 0; run < runs_.size(); ++run) open_[run] = runs_.is_at_border(run);
    }
    runs_.join_neighbours(periodic,
                          [this](std::size_t a, std::size_t b, int x, int y) { join(a, b, x, y); });
  }

  const numerics::Runs& runs() const { return runs_; }
  /// Returns the first run of the region of a run.
  std::size_t root(std::size_t run) {
    return static_cast<std::size_t>(sets_.root(static_cast<std::int32_t>(run)));
  }
  bool is_open(std::size_t root_run) const { return open_[root_run] != 0; }

 private:
  using Offset = std::conditional_t<periodic, Cells, numerics::NoOffset>;

  void join(std::size_t a, std::size_t b, int x, int y) {
    const bool open = is_open(root(a)) || is_open(root(b));
    Offset cells{};
    if constexpr (periodic) cells = {x, y};
    const auto joined =
        sets_.join(static_cast<std::int32_t>(a), static_cast<std::int32_t>(b), cells);
    const bool runs_through = joined.were_one && !(joined.difference == Offset{});
    open_[static_cast<std::size_t>(joined.root)] = open || runs_through;
  }

  numerics::Runs runs_;
  numerics::DisjointSets<std::int32_t, Offset> sets_;
  std::vector<std::uint8_t> open_;  // of root runs: there is a way out
};

}  // namespace tabor::contact
