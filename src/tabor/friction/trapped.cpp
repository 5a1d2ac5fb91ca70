#include "tabor/friction/trapped.hpp"

#include <algorithm>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "tabor/core/error.hpp"
#include "tabor/numerics/disjoint_sets.hpp"

namespace tabor::friction {
namespace {

/// Periodic cells from one place to another.
struct Cells {
  std::int32_t x = 0;
  std::int32_t y = 0;
  Cells operator+(Cells o) const { return {x + o.x, y + o.y}; }
  Cells operator-(Cells o) const { return {x - o.x, y - o.y}; }
  bool operator==(const Cells&) const = default;
};

/// Connected regions of the gap by their first pixels. In a periodic cell the sets have offsets:
/// two paths to one pixel that differ by whole cells show that a region runs through the cell.
template <bool periodic>
class Regions {
 public:
  explicit Regions(Index n)
      : sets_(static_cast<std::size_t>(n)), open_(static_cast<std::size_t>(n), 0) {}

  Index root(Index pixel) { return sets_.root(static_cast<std::int32_t>(pixel)); }

  /// `b` is a neighbour of `a`, so many periodic cells further.
  void join(Index a, Index b, Cells cells) {
    const bool open = is_open(root(a)) || is_open(root(b));
    const auto joined =
        sets_.join(static_cast<std::int32_t>(a), static_cast<std::int32_t>(b), offset_of(cells));
    const bool runs_through = joined.were_one && !(joined.difference == Offset{});
    open_[static_cast<std::size_t>(joined.root)] = open || runs_through;
  }

  void mark_open(Index pixel) { open_[static_cast<std::size_t>(root(pixel))] = 1; }
  bool is_open(Index root_pixel) const { return open_[static_cast<std::size_t>(root_pixel)] != 0; }

 private:
  using Offset = std::conditional_t<periodic, Cells, numerics::NoOffset>;

  static Offset offset_of(Cells cells) {
    if constexpr (periodic) return cells;
    return {};
  }

  numerics::DisjointSets<std::int32_t, Offset> sets_;
  std::vector<std::uint8_t> open_;  // of roots: liquid can leave
};

void check_shape(Index rows, Index cols, const Grid& grid, const char* what) {
  if (rows != grid.ny || cols != grid.nx) {
    throw InputError(std::string(what) + ": not on the grid of the contact");
  }
}

template <bool periodic>
void join_neighbours(Regions<periodic>& regions, const Mask& contact, const Grid& grid) {
  const auto is_gap = [&](Index row, Index column) { return !contact(row, column); };
  for (Index row = 0; row < grid.ny; ++row) {
    for (Index column = 0; column < grid.nx; ++column) {
      if (!is_gap(row, column)) continue;
      const Index pixel = row * grid.nx + column;
      const bool last_column = column + 1 == grid.nx;
      const bool last_row = row + 1 == grid.ny;
      if (!periodic && (row == 0 || column == 0 || last_row || last_column)) {
        regions.mark_open(pixel);
      }
      const Index right = last_column ? 0 : column + 1;
      const Index below = last_row ? 0 : row + 1;
      if ((periodic || !last_column) && is_gap(row, right)) {
        regions.join(pixel, row * grid.nx + right, {last_column ? 1 : 0, 0});
      }
      if ((periodic || !last_row) && is_gap(below, column)) {
        regions.join(pixel, below * grid.nx + column, {0, last_row ? 1 : 0});
      }
    }
  }
}

/// Liquid [m] summed over contact pixels; the regions' own sums go into `result`, by root.
template <bool periodic>
double add_up(Regions<periodic>& regions, const Mask& contact, const Field& film, const Field& gap,
              double pixel_area, std::vector<GapRegion>& result) {
  std::vector<std::int32_t> position(static_cast<std::size_t>(film.size()), -1);
  double under_contact = 0;
  for (Index pixel = 0; pixel < film.size(); ++pixel) {
    if (contact.data()[pixel]) {
      under_contact += film.data()[pixel];
      continue;
    }
    const Index root = regions.root(pixel);
    std::int32_t& place = position[static_cast<std::size_t>(root)];
    if (place < 0) {
      place = static_cast<std::int32_t>(result.size());
      result.push_back({0, root, 0, 0, !regions.is_open(root)});
    }
    GapRegion& region = result[static_cast<std::size_t>(place)];
    ++region.n_pixels;
    region.liquid_volume += film.data()[pixel] * pixel_area;
    region.gap_volume += std::max(gap.data()[pixel], 0.0) * pixel_area;
  }
  return under_contact * pixel_area;
}

/// As add_up() of all regions.
template <bool periodic>
double add_up_regions(const Mask& contact, const Field& film, const Field& gap, const Grid& grid,
                      std::vector<GapRegion>& result) {
  Regions<periodic> regions(grid.size());
  join_neighbours(regions, contact, grid);
  return add_up(regions, contact, film, gap, grid.pixel_area(), result);
}

}  // namespace

TrappedLiquid trapped_liquid(const Mask& contact, const Field& film, const Field& gap,
                             const Grid& grid, bool periodic) {
  check_shape(contact.rows(), contact.cols(), grid, "contact");
  check_shape(film.rows(), film.cols(), grid, "film");
  check_shape(gap.rows(), gap.cols(), grid, "gap");
  if (!film.allFinite() || !gap.allFinite()) {
    throw InputError("film or gap has NaN or infinite values");
  }
  TrappedLiquid result;
  const double under_contact =
      periodic ? add_up_regions<true>(contact, film, gap, grid, result.regions)
               : add_up_regions<false>(contact, film, gap, grid, result.regions);
  std::erase_if(result.regions, [](const GapRegion& region) { return region.liquid_volume == 0; });
  double trapped = 0;
  double escaping = 0;
  for (const GapRegion& region : result.regions) {
    (region.trapped ? trapped : escaping) += region.liquid_volume;
  }
  if (const double total = trapped + escaping + under_contact; total > 0) {
    result.trapped_fraction = trapped / total;
    result.escaping_fraction = escaping / total;
    result.under_contact_fraction = under_contact / total;
  }
  return result;
}

}  // namespace tabor::friction
