#include "tabor/friction/trapped.hpp"

#include <algorithm>
#include <cstdint>
#include <numeric>

#include "tabor/core/error.hpp"

namespace tabor::friction {
namespace {

/// Union-find over pixels that also knows, for each pixel, how many cells away from its root it was
/// reached. Two paths to one pixel that differ by whole cells show that the region runs through the
/// periodic cell (Newman & Ziff 2001, doi:10.1103/PhysRevE.64.016706).
class Regions {
 public:
  Regions(Index n, bool periodic)
      : parent_(static_cast<std::size_t>(n)), open_(static_cast<std::size_t>(n), 0) {
    std::iota(parent_.begin(), parent_.end(), std::int32_t{0});
    if (periodic) shift_.resize(static_cast<std::size_t>(n), Shift{0, 0});
  }

  Index root(Index pixel) {
    Index top = pixel;
    Shift total{0, 0};
    while (parent(top) != top) {
      total = total + shift(top);
      top = parent(top);
    }
    while (parent(pixel) != top && pixel != top) {
      const Index next = parent(pixel);
      const Shift step = shift(pixel);
      set(pixel, top, total);
      total = total - step;
      pixel = next;
    }
    return top;
  }

  /// `b` is a neighbour of `a`, `cells` periodic cells further.
  void join(Index a, Index b, std::int32_t cells_x, std::int32_t cells_y) {
    const Index root_a = root(a);
    const Index root_b = root(b);
    const Shift between = shift_from_root(a) + Shift{cells_x, cells_y} - shift_from_root(b);
    if (root_a == root_b) {
      if (between.x != 0 || between.y != 0) mark_open(root_a);
      return;
    }
    const bool open = is_open(root_a) || is_open(root_b);
    const Index keep = std::min(root_a, root_b);  // the root is the region's first pixel
    const Index drop = std::max(root_a, root_b);
    set(drop, keep, drop == root_b ? between : Shift{0, 0} - between);
    open_[static_cast<std::size_t>(keep)] = open;
  }

  void mark_open(Index pixel) { open_[static_cast<std::size_t>(root(pixel))] = 1; }
  bool is_open(Index root_pixel) const { return open_[static_cast<std::size_t>(root_pixel)] != 0; }

 private:
  struct Shift {
    std::int32_t x;
    std::int32_t y;
    Shift operator+(Shift o) const { return {x + o.x, y + o.y}; }
    Shift operator-(Shift o) const { return {x - o.x, y - o.y}; }
  };

  Index parent(Index pixel) const { return parent_[static_cast<std::size_t>(pixel)]; }
  Shift shift(Index pixel) const {
    return shift_.empty() ? Shift{0, 0} : shift_[static_cast<std::size_t>(pixel)];
  }
  /// After root(pixel): its parent is the root, or it is the root itself.
  Shift shift_from_root(Index pixel) const { return shift(pixel); }
  void set(Index pixel, Index new_parent, Shift new_shift) {
    parent_[static_cast<std::size_t>(pixel)] = static_cast<std::int32_t>(new_parent);
    if (!shift_.empty()) shift_[static_cast<std::size_t>(pixel)] = new_shift;
  }

  std::vector<std::int32_t> parent_;
  std::vector<Shift> shift_;        // cells from the parent, empty unless periodic
  std::vector<std::uint8_t> open_;  // of roots: liquid can leave
};

void check_shape(Index rows, Index cols, const Grid& grid, const char* what) {
  if (rows != grid.ny || cols != grid.nx) {
    throw InputError(std::string(what) + ": not on the grid of the contact");
  }
}

void join_neighbours(Regions& regions, const Mask& contact, const Grid& grid, bool periodic) {
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
        regions.join(pixel, row * grid.nx + right, last_column ? 1 : 0, 0);
      }
      if ((periodic || !last_row) && is_gap(below, column)) {
        regions.join(pixel, below * grid.nx + column, 0, last_row ? 1 : 0);
      }
    }
  }
}

/// Liquid [m] summed over contact pixels; the regions' own sums go into `result`, by root.
double add_up(Regions& regions, const Mask& contact, const Field& film, const Field& gap,
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

}  // namespace

TrappedLiquid trapped_liquid(const Mask& contact, const Field& film, const Field& gap,
                             const Grid& grid, bool periodic) {
  check_shape(contact.rows(), contact.cols(), grid, "contact");
  check_shape(film.rows(), film.cols(), grid, "film");
  check_shape(gap.rows(), gap.cols(), grid, "gap");
  if (!film.allFinite() || !gap.allFinite()) {
    throw InputError("film or gap has NaN or infinite values");
  }
  Regions regions(grid.size(), periodic);
  join_neighbours(regions, contact, grid, periodic);
  TrappedLiquid result;
  const double under_contact =
      add_up(regions, contact, film, gap, grid.pixel_area(), result.regions);
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
