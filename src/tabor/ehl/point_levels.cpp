#include "tabor/ehl/point_levels.hpp"

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

PointTransfer::PointTransfer(const Grid& fine, const Grid& coarse)
    : fine_(fine), coarse_(coarse), x_(places(fine.nx, coarse.nx)), y_(places(fine.ny, coarse.ny)) {
  weight_ = transposed(Field::Ones(fine.ny, fine.nx));
}

std::vector<PointTransfer::Place> PointTransfer::places(Index fine, Index coarse) {
  const double step = static_cast<double>(coarse - 1) / static_cast<double>(fine - 1);
  std::vector<Place> result(static_cast<std::size_t>(fine));
  double place = 0;
  for (Index i = 0; i < fine; ++i) {
    place = static_cast<double>(i) * step;
    Place& at = result[static_cast<std::size_t>(i)];
    at.lower = std::clamp(static_cast<Index>(place), Index{0}, coarse - 2);
    at.share = place - static_cast<double>(at.lower);
  }
  return result;
}

Field PointTransfer::to_fine(const Field& coarse) const {
  Field fine(fine_.ny, fine_.nx);
  for (Index j = 0; j < fine_.ny; ++j) {
    const auto [b, t] = y_[static_cast<std::size_t>(j)];
    for (Index i = 0; i < fine_.nx; ++i) {
      const auto [a, s] = x_[static_cast<std::size_t>(i)];
      fine(j, i) = (1 - t) * ((1 - s) * coarse(b, a) + s * coarse(b, a + 1)) +
                   t * ((1 - s) * coarse(b + 1, a) + s * coarse(b + 1, a + 1));
    }
  }
  return fine;
}

Field PointTransfer::transposed(const Field& fine) const {
  Field coarse = Field::Zero(coarse_.ny, coarse_.nx);
  for (Index j = 0; j < fine_.ny; ++j) {
    const auto [b, t] = y_[static_cast<std::size_t>(j)];
    for (Index i = 0; i < fine_.nx; ++i) {
      const auto [a, s] = x_[static_cast<std::size_t>(i)];
      const double value = fine(j, i);
      coarse(b, a) += (1 - t) * (1 - s) * value;
      coarse(b, a + 1) += (1 - t) * s * value;
      coarse(b + 1, a) += t * (1 - s) * value;
      coarse(b + 1, a + 1) += t * s * value;
    }
  }
  return coarse;
}

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
