#pragma once

#include <vector>

#include "tabor/core/loops.hpp"
#include "tabor/core/types.hpp"
#include "tabor/elastic/border.hpp"

namespace tabor::contact {

/// Applies an approximate inverse of the elastic operator on a set of pixels: the kernel of E* |q|
/// / 2 on the grid, times a triangular taper in x and y. The taper keeps it positive definite
/// (product of two positive definite kernels, Schur) and compact, so that it can act on scattered
/// contact pixels alone. LongWaves adds what the taper cuts off.
class Preconditioner {
 public:
  /// Computes the kernel. border: where the neighbours of pixels at the border are.
  Preconditioner(const Grid& grid, double effective_modulus, elastic::Border border);

  /// Computes out[k] = sum over the set of kernel * residual at pixel set[k], row_sums[k] = sum
  /// over the set of the kernel. `residual` has shape (ny, nx) and is zero off the set; a pixel of
  /// the set where it is zero is not counted.
  void apply(const PixelList& set, const FieldF& residual, std::vector<float>& out,
             std::vector<float>& row_sums) const;

  /// Returns the kernel value at the pixel itself [Pa/m]: the stiffness of a lone contact pixel.
  double diagonal() const { return diagonal_; }
  /// Returns the sum of the kernel [Pa/m]: the stiffness of a large contact against long waves.
  double plateau() const;

 private:
  struct Sums {
    float product;
    float row;
  };
  Sums sum_around(const float* corner, Index row_stride) const;
  Sums sum_at_edge(const FieldF& residual, Index y, Index x) const;
  Index pixel_or_none(Index k, Index n) const;

  Grid grid_;
  elastic::Border border_;
  double diagonal_ = 0;        // [Pa/m]
  std::vector<float> kernel_;  // [Pa/m], (2 r - 1) rows of kRowLength, zero-padded
};

}  // namespace tabor::contact
