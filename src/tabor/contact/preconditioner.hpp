#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "tabor/core/types.hpp"
#include "tabor/spectral/fft.hpp"

namespace tabor::contact {

using PixelList = std::vector<std::uint32_t>;  ///< linear pixel indices, ascending

/// Approximate inverse of the elastic operator on a set of pixels: the kernel of E* |q| / 2 on the
/// grid, times a triangular taper in x and y. The taper keeps it positive definite (product of two
/// positive definite kernels, Schur) and compact, so that it can act on scattered contact pixels
/// alone. Small sets are summed directly with a short kernel, large ones convolved by FFT with a
/// long one.
class Preconditioner {
 public:
  /// wraps: neighbours continue across the edges (periodic cell).
  Preconditioner(const Grid& grid, double effective_modulus, bool wraps);

  /// out[k] = sum over the set of kernel * residual at pixel set[k]. `residual` has shape (ny, nx)
  /// and is zero off the set.
  void apply(const PixelList& set, const FieldF& residual, std::vector<float>& out);

  /// Kernel value at the pixel itself [Pa/m]: the stiffness of a lone contact pixel.
  double diagonal() const { return diagonal_; }

  double fft_pairs() const { return fft_pairs_; }

 private:
  void sum_directly(const PixelList& set, const FieldF& residual, std::vector<float>& out) const;
  void convolve(const PixelList& set, const FieldF& residual, std::vector<float>& out);
  float sum_at_edge(const FieldF& residual, Index y, Index x) const;

  Grid grid_;
  bool wraps_;
  double modulus_;             // E* [Pa]
  double diagonal_ = 0;        // [Pa/m]
  std::vector<float> kernel_;  // [Pa/m], (2 r - 1) rows of kRowLength, zero-padded
  FieldF spectrum_;            // [Pa/m], shape (nx/2 + 1, ny/2 + 1); empty until first used
  FieldF scratch_;             // (ny, nx)
  std::unique_ptr<spectral::Convolution<float>> convolution_;
  double fft_pairs_ = 0;
};

}  // namespace tabor::contact
