#include "tabor/contact/preconditioner.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "tabor/core/parallel.hpp"

namespace tabor::contact {
namespace {

constexpr Index kRadius = 8;               // taper reaches zero this many pixels away
constexpr Index kSide = 2 * kRadius - 1;   // pixels with a weight, along each axis
constexpr Index kRowLength = 2 * kRadius;  // one vector register of floats; the last weight is zero
constexpr Index kKernelGrid = 64;          // cell on which the short kernel is computed
/// Above this share of the pixels a transform is cheaper than direct sums.
constexpr double kFftShare = 0.15;
/// Reach of the long kernel, as a share of the grid: long waves of large contacts are seen by it.
constexpr Index kLongRadiusDivisor = 8;

double taper(Index offset, Index radius) {
  return std::max(0.0, 1 - static_cast<double>(std::abs(offset)) / static_cast<double>(radius));
}

/// Kernel of E* |q| / 2 on a periodic grid, as values at offsets (y, x), 0 <= y <= my/2, 0 <= x <=
/// mx/2.
Field stiffness_kernel(Index my, Index mx, double dy, double dx, double modulus) {
  const auto symbol = [&](Index ky, Index kx) {
    return 0.5 * modulus *
           std::hypot(spectral::wavevector(kx, mx, static_cast<double>(mx) * dx),
                      spectral::wavevector(ky, my, static_cast<double>(my) * dy));
  };
  // The symbol is even, so that its inverse transform is the forward one over the pixel count.
  return spectral::even_spectrum(my, mx, symbol).transpose() / static_cast<double>(my * mx);
}

}  // namespace

Preconditioner::Preconditioner(const Grid& grid, double effective_modulus, bool wraps)
    : grid_(grid), wraps_(wraps), modulus_(effective_modulus), kernel_(kSide * kRowLength, 0.0F) {
  const Field kernel =
      stiffness_kernel(kKernelGrid, kKernelGrid, grid.dy(), grid.dx(), effective_modulus);
  diagonal_ = kernel(0, 0);
  for (Index y = 1 - kRadius; y < kRadius; ++y) {
    for (Index x = 1 - kRadius; x < kRadius; ++x) {
      const double value = kernel(std::abs(y), std::abs(x)) * taper(y, kRadius) * taper(x, kRadius);
      kernel_[static_cast<std::size_t>((y + kRadius - 1) * kRowLength + x + kRadius - 1)] =
          static_cast<float>(value);
    }
  }
}

void Preconditioner::apply(const PixelList& set, const FieldF& residual, std::vector<float>& out) {
  out.resize(set.size());
  const bool large =
      static_cast<double>(set.size()) > kFftShare * static_cast<double>(grid_.size());
  if (large && std::min(grid_.nx, grid_.ny) >= 4 * kRadius) {
    convolve(set, residual, out);
  } else {
    sum_directly(set, residual, out);
  }
}

float Preconditioner::sum_at_edge(const FieldF& residual, Index y, Index x) const {
  const auto wrapped = [](Index k, Index n) { return ((k % n) + n) % n; };
  float sum = 0;
  for (Index j = 0; j < kSide; ++j) {
    for (Index i = 0; i < kSide; ++i) {
      const Index row = y + j - (kRadius - 1);
      const Index column = x + i - (kRadius - 1);
      const bool outside = row < 0 || row >= grid_.ny || column < 0 || column >= grid_.nx;
      if (outside && !wraps_) {
        continue;
      }
      sum += kernel_[static_cast<std::size_t>(j * kRowLength + i)] *
             residual(wrapped(row, grid_.ny), wrapped(column, grid_.nx));
    }
  }
  return sum;
}

void Preconditioner::sum_directly(const PixelList& set, const FieldF& residual,
                                  std::vector<float>& out) const {
  const Index nx = grid_.nx;
  parallel_for(static_cast<Index>(set.size()), 2048, [&](Index begin, Index end) {
    for (Index k = begin; k < end; ++k) {
      const Index pixel = set[static_cast<std::size_t>(k)];
      const Index y = pixel / nx;
      const Index x = pixel % nx;
      const bool inside =
          x >= kRadius && x < nx - kRadius && y >= kRadius && y < grid_.ny - kRadius;
      if (!inside) {
        out[static_cast<std::size_t>(k)] = sum_at_edge(residual, y, x);
        continue;
      }
      using Row = Eigen::Array<float, kRowLength, 1>;
      Row sum = Row::Zero();
      const float* corner = residual.data() + (y - (kRadius - 1)) * nx + x - (kRadius - 1);
      for (Index j = 0; j < kSide; ++j) {
        sum += Eigen::Map<const Row>(kernel_.data() + j * kRowLength) *
               Eigen::Map<const Row>(corner + j * nx);
      }
      out[static_cast<std::size_t>(k)] = sum.sum();
    }
  });
}

void Preconditioner::convolve(const PixelList& set, const FieldF& residual,
                              std::vector<float>& out) {
  if (!convolution_) {
    const Field kernel = stiffness_kernel(grid_.ny, grid_.nx, grid_.dy(), grid_.dx(), modulus_);
    const Index reach = std::max(kRadius, std::min(grid_.nx, grid_.ny) / kLongRadiusDivisor);
    spectrum_ = spectral::even_spectrum(grid_.ny, grid_.nx, [&](Index y, Index x) {
                  return kernel(y, x) * taper(y, reach) * taper(x, reach);
                }).cast<float>();
    convolution_ = std::make_unique<spectral::Convolution<float>>(grid_.ny, grid_.nx);
    scratch_.resize(grid_.ny, grid_.nx);
  }
  convolution_->apply(
      residual.data(),
      [this](Index kx, std::span<float> values) {
        std::copy_n(spectrum_.data() + kx * spectrum_.cols(), values.size(), values.begin());
      },
      scratch_.data());
  fft_pairs_ += 1;
  const float* values = scratch_.data();
  parallel_for(static_cast<Index>(set.size()), kBlock, [&](Index begin, Index end) {
    for (auto k = static_cast<std::size_t>(begin); k < static_cast<std::size_t>(end); ++k) {
      out[k] = values[set[k]];
    }
  });
}

}  // namespace tabor::contact
