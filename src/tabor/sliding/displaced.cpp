#include "tabor/sliding/displaced.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "tabor/core/loops.hpp"
#include "tabor/core/rows.hpp"
#include "tabor/spectral/fft.hpp"

namespace tabor::sliding {
namespace {

constexpr double kExact = 1e-15;       // relative: of volumes
constexpr double kNegligible = 1e-12;  // of the largest weight: rounding of the transforms
constexpr int kMostSteps = 100;

/// Applies a Gaussian of this deviation [m] to a map that repeats.
void spread(Field& map, const Grid& grid, double reach) {
  const auto decay = [reach](Index k, Index n, double side) {
    const double phase = spectral::wavevector(k, n, side) * reach;
    return std::exp(-0.5 * phase * phase);
  };
  std::vector<double> along_y(static_cast<std::size_t>(grid.ny / 2 + 1));
  for (Index ky = 0; ky <= grid.ny / 2; ++ky) {
    along_y[static_cast<std::size_t>(ky)] = decay(ky, grid.ny, grid.ly);
  }
  spectral::Convolution<double>(grid.ny, grid.nx)
      .apply(
          map.data(),
          [&](Index kx, std::span<double> values) {
            const double along_x = decay(kx, grid.nx, grid.lx);
            std::transform(along_y.begin(), along_y.end(), values.begin(),
                           [along_x](double along) { return along * along_x; });
          },
          map.data());
}

/// The c with sum min(c weight, space) = volume: Newton on a concave, piecewise linear function,
/// which is below its goal after every step. Ends where all have their space.
template <typename Space>
double scale_for_volume(const Field& weight, const Space& space, double volume) {
  double scale = 0;
  for (int step = 0; step < kMostSteps; ++step) {
    const auto sums = sum_over_rows<2>(weight.rows(), [&](Index y) {
      Eigen::Array2d row(0, 0);  // filled, and the weight of what is not full
      for (Index i = y * weight.cols(); i < (y + 1) * weight.cols(); ++i) {
        const double wanted = scale * weight(i);
        const double most = weight(i) > 0 ? space(i) : 0;
        row(0) += std::min(wanted, most);
        if (wanted < most) row(1) += weight(i);
      }
      return row;
    });
    const double missing = volume - sums(0);
    if (missing <= kExact * volume || sums(1) <= 0) break;
    const double next = scale + missing / sums(1);
    if (next == scale) break;
    scale = next;
  }
  return scale;
}

}  // namespace

Raised raise(Displaced displaced, Field depth, const Mask& contact, const Field& gap,
             const Grid& grid, double reach) {
  Raised raised;
  const double volume = raised.volume = sum(depth);
  const Index n_free = count_where(depth.size(), [&](Index i) { return !contact(i); });
  if (displaced == Displaced::lost || n_free == 0 || !(volume > 0)) {
    raised.height = Field::Zero(grid.ny, grid.nx);
    raised.lost = volume;
    return raised;
  }
  Field weight = std::move(depth);
  if (displaced == Displaced::near) {
    spread(weight, grid, reach);
  } else {
    for_each(weight.size(), [&](Index i) { weight(i) = 1; });
  }
  const double least = kNegligible * extent_of(weight).highest;
  const auto space = [&](Index i) { return std::max(gap(i), 0.0); };
  for_each(weight.size(), [&](Index i) {
    if (contact(i) || weight(i) < least) weight(i) = 0;
  });
  const double scale = scale_for_volume(weight, space, volume);
  raised.height = std::move(weight);
  for_each(raised.height.size(), [&](Index i) {
    if (raised.height(i) > 0) raised.height(i) = std::min(scale * raised.height(i), space(i));
  });
  const double missing = volume - sum(raised.height);
  if (missing > kNegligible * volume) raised.without_space = missing;
  // What is missing, be it by rounding alone, rises evenly.
  const double each = missing / static_cast<double>(n_free);
  for_each(raised.height.size(), [&](Index i) {
    if (!contact(i)) raised.height(i) = std::max(0.0, raised.height(i) + each);
  });
  return raised;
}

}  // namespace tabor::sliding
