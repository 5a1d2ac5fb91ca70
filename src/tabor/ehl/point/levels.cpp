#include "tabor/ehl/point/levels.hpp"

#include <algorithm>

namespace tabor::ehl {
namespace {

constexpr Index kCoarsest = 40;  // nodes along the longer side of a grid that is not coarsened

/// About half as many nodes on the same domain, from border node to border node.
Grid coarser(const Grid& grid) {
  Grid coarse{.nx = (grid.nx + 1) / 2, .ny = (grid.ny + 1) / 2};
  const auto extent = [](double spacing, Index fine, Index n) {
    return spacing * static_cast<double>(fine - 1) / static_cast<double>(n - 1) *
           static_cast<double>(n);
  };
  coarse.lx = extent(grid.dx(), grid.nx, coarse.nx);
  coarse.ly = extent(grid.dy(), grid.ny, coarse.ny);
  return coarse;
}

}  // namespace

std::vector<PointLevel> point_levels(const Grid& grid, double effective_modulus, double unit,
                                     bool coarsen) {
  std::vector<PointLevel> levels;
  Grid now = grid;
  for (;;) {
    levels.push_back({now, PointElastic(now, effective_modulus, unit), {}});
    if (!coarsen || std::max(now.nx, now.ny) <= kCoarsest) return levels;
    const Grid next = coarser(now);
    levels.back().to_coarser.emplace(now, next);
    now = next;
  }
}

}  // namespace tabor::ehl
