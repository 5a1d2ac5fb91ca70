#pragma once

#include <vector>

#include "tabor/core/types.hpp"

namespace tabor::numerics {

/// Transfers values between the nodes of two grids of the same domain, from border to border, by
/// linear interpolation. The grids may have any numbers of nodes, two or more along each side.
class NodeTransfer {
 public:
  /// Only the numbers of nodes of the grids count.
  NodeTransfer(const Grid& fine, const Grid& coarse);

  /// Interpolates a coarse field, (ny, nx) of the coarse grid, to the nodes of the fine grid.
  Field to_fine(const Field& coarse) const;
  /// Applies the transpose of to_fine().
  Field transposed(const Field& fine) const;
  /// Returns means around the nodes of the coarse grid.
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

}  // namespace tabor::numerics
