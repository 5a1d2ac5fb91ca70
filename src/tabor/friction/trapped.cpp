#include "tabor/friction/trapped.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

#include "tabor/contact/trapped/regions.hpp"
#include "tabor/core/error.hpp"
#include "tabor/core/loops.hpp"

namespace tabor::friction {
namespace {

void check_shape(Index rows, Index cols, const Grid& grid, const char* what) {
  if (rows != grid.ny || cols != grid.nx) {
    throw InputError(std::string(what) + ": not on the grid of the contact");
  }
}

/// Liquid [m] summed over the pixels of contact, which lie between the runs of gap.
double under_contact(const numerics::Runs& gap, const Field& film) {
  double sum = 0;
  Index pixel = 0;
  for (std::size_t run = 0; run < gap.size(); ++run) {
    for (; pixel < gap[run].begin; ++pixel) sum += film.data()[pixel];
    pixel = gap[run].end;
  }
  for (; pixel < film.size(); ++pixel) sum += film.data()[pixel];
  return sum;
}

/// Liquid [m^3] under contact; the regions' own sums go into `result`, by root.
template <elastic::Border border>
double add_up(contact::Regions<border>& regions, const Field& film, const Field& gap,
              double pixel_area, std::vector<GapRegion>& result) {
  const numerics::Runs& runs = regions.runs();
  std::vector<std::int32_t> position(runs.size(), -1);
  for (std::size_t run = 0; run < runs.size(); ++run) {
    const std::size_t root = regions.root(run);
    std::int32_t& place = position[root];
    if (place < 0) {
      place = static_cast<std::int32_t>(result.size());
      result.push_back({0, runs[root].begin, 0, 0, !regions.is_open(root)});
    }
    GapRegion& region = result[static_cast<std::size_t>(place)];
    region.n_pixels += runs[run].end - runs[run].begin;
    for (Index pixel = runs[run].begin; pixel < runs[run].end; ++pixel) {
      region.liquid_volume += film.data()[pixel] * pixel_area;
      region.gap_volume += std::max(gap.data()[pixel], 0.0) * pixel_area;
    }
  }
  return under_contact(runs, film) * pixel_area;
}

/// As add_up() of all regions.
template <elastic::Border border>
double add_up_regions(const Mask& contact, const Field& film, const Field& gap, const Grid& grid,
                      std::vector<GapRegion>& result) {
  const bool* touching = contact.data();
  contact::Regions<border> regions(grid, [touching](Index i) { return !touching[i]; });
  return add_up(regions, film, gap, grid.pixel_area(), result);
}

}  // namespace

TrappedLiquid trapped_liquid(const Mask& contact, const Field& film, const Field& gap,
                             const Grid& grid, bool periodic) {
  check_shape(contact.rows(), contact.cols(), grid, "contact");
  check_shape(film.rows(), film.cols(), grid, "film");
  check_shape(gap.rows(), gap.cols(), grid, "gap");
  if (!all_finite(film) || !all_finite(gap)) {
    throw InputError("film or gap has NaN or infinite values");
  }
  TrappedLiquid result;
  const double under_contact =
      periodic ? add_up_regions<elastic::Border::repeats>(contact, film, gap, grid, result.regions)
               : add_up_regions<elastic::Border::ends>(contact, film, gap, grid, result.regions);
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
