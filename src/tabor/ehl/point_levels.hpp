#pragma once

#include <optional>
#include <vector>

#include "tabor/ehl/point_elastic.hpp"

namespace tabor::ehl {

/// Straight lines between the nodes of two grids of the same domain, from border to border. Their
/// numbers of nodes may be any.
class PointTransfer {
 public:
  PointTransfer(const Grid& fine, const Grid& coarse);

  Field to_fine(const Field& coarse) const;
  /// The transposed of to_fine().
  Field transposed(const Field& fine) const;
  /// Means around the nodes of the coarse grid.
  Field mean(const Field& fine) const { return transposed(fine) / weight_; }

 private:
  struct Place {
    Index lower;   // node of the coarse grid
    double share;  // of the next one
  };
  static std::vector<Place> places(Index fine, Index coarse);

  Grid fine_, coarse_;
  std::vector<Place> x_, y_;
  Field weight_;  // transposed(1)
};

/// A grid of the film and what it takes to correct it by the next coarser one.
struct PointLevel {
  Grid grid;
  PointElastic elastic;
  std::optional<PointTransfer> to_coarser;  ///< none: the coarsest
};

/// The grid of a film and coarser ones with about half as many nodes along each side. `unit`: as
/// for PointElastic. Without `coarsen`, the grid of the film alone.
std::vector<PointLevel> point_levels(const Grid& grid, double effective_modulus, double unit,
                                     bool coarsen = true);

}  // namespace tabor::ehl
