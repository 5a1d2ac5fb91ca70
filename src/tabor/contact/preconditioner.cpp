#include "tabor/contact/preconditioner.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numeric>

#include "tabor/core/loops.hpp"
#include "tabor/core/registers.hpp"
#include "tabor/spectral/fft.hpp"

namespace tabor::contact {
namespace {

constexpr Index kRadius = 8;               // taper reaches zero this many pixels away
constexpr Index kSide = 2 * kRadius - 1;   // pixels with a weight, along each axis
constexpr Index kRowLength = 2 * kRadius;  // whole vector registers; the last weight is zero
constexpr Index kKernelGrid = 64;          // cell on which the short kernel is computed
constexpr Index kNone = -1;
constexpr Index kPixelsPerBlock = 2048;  // of a thread: each pixel is work

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

/// A row of the kernel, or of residuals under it; compilers leave the loop over plain floats
/// scalar.
constexpr std::size_t kParts = kRowLength / kFloatLanes;
using Row = std::array<FloatLanes, kParts>;

/// One by one: copied at once, a row goes through memory.
FloatLanes load(const float* values) {
  FloatLanes lanes;
  std::memcpy(&lanes, values, sizeof lanes);
  return lanes;
}

/// Sum over a row, halves by halves.
float total(Row row) {
  for (std::size_t half = kParts / 2; half > 0; half /= 2) {
    for (std::size_t i = 0; i < half; ++i) row[i] += row[i + half];
  }
  std::array<float, kFloatLanes> sums{};
  std::memcpy(sums.data(), row.data(), sizeof sums);
  for (std::size_t half = kFloatLanes / 2; half > 0; half /= 2) {
    for (std::size_t i = 0; i < half; ++i) sums[i] += sums[i + half];
  }
  return sums[0];
}

}  // namespace

Preconditioner::Preconditioner(const Grid& grid, double effective_modulus, elastic::Border border)
    : grid_(grid), border_(border), kernel_(kSide * kRowLength, 0.0F) {
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

Preconditioner::Sums Preconditioner::sum_around(const float* corner, Index row_stride) const {
  Row products{};
  Row weights{};
  for (Index j = 0; j < kSide; ++j) {
    for (std::size_t i = 0; i < kParts; ++i) {
      const FloatLanes kernel = load(kernel_.data() + j * kRowLength + i * kFloatLanes);
      const FloatLanes residual = load(corner + j * row_stride + i * kFloatLanes);
      products[i] += kernel * residual;
      weights[i] += residual != 0.0F ? kernel : FloatLanes{};
    }
  }
  return {total(products), total(weights)};
}

Preconditioner::Sums Preconditioner::sum_at_edge(const FieldF& residual, Index y, Index x) const {
  std::array<float, kSide * kRowLength> around{};
  std::array<Index, kRowLength> columns{};
  for (Index i = 0; i < kRowLength; ++i) {
    columns[static_cast<std::size_t>(i)] = pixel_or_none(x + i - (kRadius - 1), grid_.nx);
  }
  for (Index j = 0; j < kSide; ++j) {
    const Index row = pixel_or_none(y + j - (kRadius - 1), grid_.ny);
    for (std::size_t i = 0; i < kRowLength && row != kNone; ++i) {
      if (columns[i] != kNone) {
        around[static_cast<std::size_t>(j * kRowLength) + i] = residual(row, columns[i]);
      }
    }
  }
  return sum_around(around.data(), kRowLength);
}

/// Where pixel k of n lies if it is outside: on the other side, at its mirror image or nowhere.
Index Preconditioner::pixel_or_none(Index k, Index n) const {
  const auto wrapped = [k](Index period) { return ((k % period) + period) % period; };
  switch (border_) {
    case elastic::Border::repeats:
      return wrapped(n);
    case elastic::Border::mirrors:
      return std::min(wrapped(2 * n), 2 * n - 1 - wrapped(2 * n));
    case elastic::Border::ends:
      break;
  }
  return k < 0 || k >= n ? kNone : k;
}

void Preconditioner::apply(const PixelList& set, const FieldF& residual, std::vector<float>& out,
                           std::vector<float>& row_sums) const {
  out.resize(set.size());
  row_sums.resize(set.size());
  const Index nx = grid_.nx;
  const auto apply_at = [&](std::size_t k) {
    const Index y = set[k] / nx;
    const Index x = set[k] % nx;
    const bool inside = x >= kRadius && x < nx - kRadius && y >= kRadius && y < grid_.ny - kRadius;
    const Index corner = (y - (kRadius - 1)) * nx + x - (kRadius - 1);
    const Sums sums =
        inside ? sum_around(residual.data() + corner, nx) : sum_at_edge(residual, y, x);
    out[k] = sums.product;
    row_sums[k] = sums.row;
  };
  for_each(set.size(), apply_at, kPixelsPerBlock);
}

}  // namespace tabor::contact
