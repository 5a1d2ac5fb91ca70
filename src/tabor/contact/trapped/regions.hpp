#pragma once

#include <cstdint>
#include <type_traits>
#include <vector>

#include "tabor/core/types.hpp"
#include "tabor/elastic/border.hpp"
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
/// must connect a point with its own periodic image, and on one of the mirror images of such a cell
/// it must reach opposite borders. Sets have offsets in a periodic cell: two paths to one pixel
/// that differ by whole cells show that a region runs through the cell (Newman & Ziff 2001,
/// doi:10.1103/PhysRevE.64.016706).
template <elastic::Border border>
class Regions {
 public:
  /// belongs(pixel): the pixel is in a region.
  template <typename Belongs>
  Regions(const Grid& grid, const Belongs& belongs)
      : runs_(grid.ny, grid.nx, belongs), sets_(runs_.size()), sides_(runs_.size(), 0) {
    if constexpr (!repeats) {
      for (std::size_t run = 0; run < runs_.size(); ++run) sides_[run] = runs_.sides(run);
    }
    runs_.join_neighbours(repeats,
                          [this](std::size_t a, std::size_t b, int x, int y) { join(a, b, x, y); });
  }

  const numerics::Runs& runs() const { return runs_; }
  /// Returns the first run of the region of a run.
  std::size_t root(std::size_t run) {
    return static_cast<std::size_t>(sets_.root(static_cast<std::int32_t>(run)));
  }
  bool is_open(std::size_t root_run) const {
    const std::uint8_t sides = sides_[root_run];
    if constexpr (border == elastic::Border::ends) return sides != 0;
    return (sides & kAcross) == kAcross || (sides & kDown) == kDown;
  }

 private:
  static constexpr bool repeats = border == elastic::Border::repeats;
  static constexpr int kAcross = numerics::Runs::kLeft | numerics::Runs::kRight;
  static constexpr int kDown = numerics::Runs::kTop | numerics::Runs::kBottom;
  using Offset = std::conditional_t<repeats, Cells, numerics::NoOffset>;

  void join(std::size_t a, std::size_t b, int x, int y) {
    const int sides = sides_[root(a)] | sides_[root(b)];
    Offset cells{};
    if constexpr (repeats) cells = {x, y};
    const auto joined =
        sets_.join(static_cast<std::int32_t>(a), static_cast<std::int32_t>(b), cells);
    const bool runs_through = joined.were_one && !(joined.difference == Offset{});
    sides_[static_cast<std::size_t>(joined.root)] =
        static_cast<std::uint8_t>(runs_through ? kAcross : sides);
  }

  numerics::Runs runs_;
  numerics::DisjointSets<std::int32_t, Offset> sets_;
  std::vector<std::uint8_t> sides_;  // that regions reach, by root run; opposite ones if one runs
                                     // through the cell
};

}  // namespace tabor::contact
