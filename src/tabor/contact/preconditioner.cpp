#include "tabor/contact/preconditioner.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "tabor/core/parallel.hpp"
#include "tabor/spectral/fft.hpp"

namespace tabor::contact {
namespace {

constexpr Index kRadius = 8;               // taper reaches zero this many pixels away
constexpr Index kSide = 2 * kRadius - 1;   // pixels with a weight, along each axis
constexpr Index kRowLength = 2 * kRadius;  // one vector register of floats; the last weight is zero
constexpr Index kKernelGrid = 64;          // cell on which the short kernel is computed

double taper(Index offset) {
  return std::max(0.0, 1 - static_cast<double>(std::abs(offset)) / static_cast<double>(kRadius));
}

/// Kernel of E* |q| / 2 on a periodic cell of kKernelGrid pixels, as values at offsets (y, x) from
/// 0 to half the cell.
Field stiffness_kernel(double dy, double dx, double modulus) {
  constexpr Index m = kKernelGrid;
  const auto symbol = [&](Index ky, Index kx) {
    return 0.5 * modulus *
           std::hypot(spectral::wavevector(kx, m, static_cast<double>(m) * dx),
                      spectral::wavevector(ky, m, static_cast<double>(m) * dy));
  };
  // The symbol is even, so that its inverse transform is the forward one over the pixel count.
  return spectral::even_spectrum(m, m, symbol).transpose() / static_cast<double>(m * m);
}

}  // namespace

Preconditioner::Preconditioner(const Grid& grid, double effective_modulus, bool wraps)
    : grid_(grid), wraps_(wraps), kernel_(kSide * kRowLength, 0.0F) {
  const Field kernel = stiffness_kernel(grid.dy(), grid.dx(), effective_modulus);
  diagonal_ = kernel(0, 0);
  for (Index y = 1 - kRadius; y < kRadius; ++y) {
    for (Index x = 1 - kRadius; x < kRadius; ++x) {
      const double value = kernel(std::abs(y), std::abs(x)) * taper(y) * taper(x);
      kernel_[static_cast<std::size_t>((y + kRadius - 1) * kRowLength + x + kRadius - 1)] =
          static_cast<float>(value);
    }
  }
}

double Preconditioner::plateau() const {
  return std::accumulate(kernel_.begin(), kernel_.end(), 0.0);
}

Preconditioner::Sums Preconditioner::sum_inside(const float* corner) const {
  // Lane by lane, so that the compiler uses vectors without reordering sums.
  std::array<float, kRowLength> products{};
  std::array<float, kRowLength> weights{};
  for (Index j = 0; j < kSide; ++j) {
    const float* kernel = kernel_.data() + j * kRowLength;
    const float* residual = corner + j * grid_.nx;
    for (std::size_t i = 0; i < kRowLength; ++i) {
      products[i] += kernel[i] * residual[i];
      weights[i] += residual[i] != 0 ? kernel[i] : 0.0F;
    }
  }
  return {std::accumulate(products.begin(), products.end(), 0.0F),
          std::accumulate(weights.begin(), weights.end(), 0.0F)};
}

Preconditioner::Sums Preconditioner::sum_at_edge(const FieldF& residual, Index y, Index x) const {
  const auto wrapped = [](Index k, Index n) { return ((k % n) + n) % n; };
  Sums sums{0, 0};
  for (Index j = 0; j < kSide; ++j) {
    for (Index i = 0; i < kSide; ++i) {
      const Index row = y + j - (kRadius - 1);
      const Index column = x + i - (kRadius - 1);
      const bool outside = row < 0 || row >= grid_.ny || column < 0 || column >= grid_.nx;
      if (outside && !wraps_) {
        continue;
      }
      const float kernel = kernel_[static_cast<std::size_t>(j * kRowLength + i)];
      const float value = residual(wrapped(row, grid_.ny), wrapped(column, grid_.nx));
      sums.product += kernel * value;
      sums.row += value != 0 ? kernel : 0;
    }
  }
  return sums;
}

void Preconditioner::apply(const PixelList& set, const FieldF& residual, std::vector<float>& out,
                           std::vector<float>& row_sums) const {
  out.resize(set.size());
  row_sums.resize(set.size());
  const Index nx = grid_.nx;
  parallel_for(static_cast<Index>(set.size()), 2048, [&](Index begin, Index end) {
    for (auto k = static_cast<std::size_t>(begin); k < static_cast<std::size_t>(end); ++k) {
      const Index y = set[k] / nx;
      const Index x = set[k] % nx;
      const bool inside =
          x >= kRadius && x < nx - kRadius && y >= kRadius && y < grid_.ny - kRadius;
      const Index corner = (y - (kRadius - 1)) * nx + x - (kRadius - 1);
      const Sums sums = inside ? sum_inside(residual.data() + corner) : sum_at_edge(residual, y, x);
      out[k] = sums.product;
      row_sums[k] = sums.row;
    }
  });
}

}  // namespace tabor::contact
