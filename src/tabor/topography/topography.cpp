#include "tabor/topography/topography.hpp"

#include <fmt/format.h>

#include "tabor/core/error.hpp"

namespace tabor::topography {

bool is_profile(const Grid& grid) { return grid.nx == 1 || grid.ny == 1; }

Mask holes(const Topography& topography) { return topography.height.isNaN(); }

Index count_holes(const Topography& topography) { return topography.height.isNaN().count(); }

void require_no_holes(const Topography& topography, const std::string& name,
                      const std::string& remedy) {
  const double copies = topography.tiles * topography.tiles;
  const auto n = static_cast<Index>(static_cast<double>(count_holes(topography)) / copies);
  if (n == 0) return;
  throw InputError(name, fmt::format("{} missing pixel{}", n, n == 1 ? "" : "s"),
                   "a height at every pixel", remedy);
}

}  // namespace tabor::topography
