#pragma once

#include <optional>
#include <vector>

#include "tabor/ehl/point/elastic.hpp"
#include "tabor/numerics/grid_transfer.hpp"

// Makes the grids of the multigrid of a point contact.
namespace tabor::ehl {

/// A grid of the film and what it takes to correct it by the next coarser one.
struct PointLevel {
  Grid grid;
  PointElastic elastic;
  std::optional<numerics::NodeTransfer> to_coarser;  ///< none: the coarsest
};

/// The grid of a film and coarser ones with about half as many nodes along each side. `unit`: as
/// for PointElastic. Without `coarsen`, the grid of the film alone.
std::vector<PointLevel> point_levels(const Grid& grid, double effective_modulus, double unit,
                                     bool coarsen = true);

}  // namespace tabor::ehl
