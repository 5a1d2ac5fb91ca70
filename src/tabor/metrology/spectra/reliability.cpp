#include "tabor/metrology/spectra/reliability.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tabor/core/error.hpp"
#include "tabor/core/parallel.hpp"
#include "tabor/topography/filters.hpp"

namespace tabor::metrology {
namespace {

/// Sharpest peak, -min of the second difference over k pixels along both axes [1/m]; negative if
/// nothing is a peak.
double sharpest_peak(const Field& z, const Grid& grid, Index k) {
  const double wx = 1 / std::pow(static_cast<double>(k) * grid.dx(), 2);
  const double wy = 1 / std::pow(static_cast<double>(k) * grid.dy(), 2);
  return parallel_max(z.size(), [&](Index begin, Index end) {
    double sharpest = -std::numeric_limits<double>::infinity();
    for (Index i = begin; i < end; ++i) {
      const Index y = i / z.cols(), x = i % z.cols();
      // A comparison with NaN (a hole) is false.
      if (x >= k && x + k < z.cols()) {
        const double bend = (2 * z(y, x) - z(y, x - k) - z(y, x + k)) * wx;
        sharpest = bend > sharpest ? bend : sharpest;
      }
      if (y >= k && y + k < z.rows()) {
        const double bend = (2 * z(y, x) - z(y - k, x) - z(y + k, x)) * wy;
        sharpest = bend > sharpest ? bend : sharpest;
      }
    }
    return sharpest;
  });
}

/// The longer side of a pixel; of a profile's the one along it.
double pixel_of(const Grid& grid) {
  return topography::is_profile(grid)
             ? topography::scan_side(grid) / static_cast<double>(grid.size())
             : std::max(grid.dx(), grid.dy());
}

}  // namespace

double tip_limited_wavelength(const Field& height, const Grid& grid, double tip_radius) {
  if (!(tip_radius > 0) || !std::isfinite(tip_radius)) {
    throw InputError("radius of the tip", fmt::format("{} m", tip_radius), "a positive length",
                     "e.g. <tip_radius=2um>");
  }
  const double limit = 0.5 / tip_radius;
  const Index most = (std::max(grid.nx, grid.ny) - 1) / 2;
  Index k = 0;
  while (k < most && sharpest_peak(height, grid, k + 1) > limit) ++k;
  return 2 * static_cast<double>(k) * pixel_of(grid);
}

TrustedRange trusted_range(const Field& height, const Grid& grid,
                           std::optional<double> tip_radius) {
  TrustedRange range;
  range.shortest = 4 * pixel_of(grid);
  range.longest =
      (topography::is_profile(grid) ? topography::scan_side(grid) : std::min(grid.lx, grid.ly)) / 4;
  if (tip_radius) {
    const double tip = tip_limited_wavelength(height, grid, *tip_radius);
    range.tip_limits = tip > range.shortest;
    range.shortest = std::max(range.shortest, tip);
  }
  return range;
}

}  // namespace tabor::metrology
