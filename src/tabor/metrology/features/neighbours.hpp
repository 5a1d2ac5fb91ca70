#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "tabor/topography/topography.hpp"

// Visits the eight neighbours of a pixel.
namespace tabor::metrology {

/// Pixel as its place in the row-major order of the map.
using PixelIndex = std::uint32_t;

/// Visits the up to eight neighbours of a pixel: none beyond an edge unless the map is periodic.
class Neighbours {
 public:
  explicit Neighbours(const topography::Topography& topography)
      : height_(topography.height.data()),
        nx_(topography.height.cols()),
        ny_(topography.height.rows()),
        periodic_(topography.periodic) {
    const double dx = topography.grid.dx(), dy = topography.grid.dy();
    inverse_distance_ = {0, 1 / dx, 1 / dy, 1 / std::hypot(dx, dy)};
  }

  /// Calls visit(neighbour, 1 / distance [1/m]) row by row, holes included.
  template <typename Visit>
  void for_each(PixelIndex pixel, const Visit& visit) const {
    for_each(pixel / nx_, pixel % nx_, visit);
  }
  template <typename Visit>
  void for_each(Index y, Index x, const Visit& visit) const {
    const bool inside = y > 0 && x > 0 && y + 1 < ny_ && x + 1 < nx_;
    for (Index step_y = -1; step_y <= 1; ++step_y) {
      for (Index step_x = -1; step_x <= 1; ++step_x) {
        const auto apart = static_cast<std::size_t>(std::abs(step_x) + 2 * std::abs(step_y));
        if (apart == 0) continue;
        const Index at_y = inside ? y + step_y : wrap(y + step_y, ny_);
        const Index at_x = inside ? x + step_x : wrap(x + step_x, nx_);
        if (at_y >= 0 && at_x >= 0) {
          visit(static_cast<PixelIndex>(at_y * nx_ + at_x), inverse_distance_[apart]);
        }
      }
    }
  }

  /// True if all eight are valid points of the map.
  bool complete(Index y, Index x) const {
    int n_valid = 0;
    for_each(y, x, [&](PixelIndex q, double) { n_valid += std::isnan(height_[q]) ? 0 : 1; });
    return n_valid == 8;
  }

 private:
  /// -1 beyond an edge.
  Index wrap(Index i, Index n) const {
    if (i >= 0 && i < n) return i;
    return periodic_ ? (i + n) % n : -1;
  }

  const double* height_;
  Index nx_, ny_;
  bool periodic_;
  std::array<double, 4> inverse_distance_;  ///< by |step_x| + 2 |step_y|
};

}  // namespace tabor::metrology
