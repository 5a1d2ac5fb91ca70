// Spectral moments as sums over the power spectrum.
#include <cmath>
#include <numbers>
#include <vector>

#include "tabor/core/error.hpp"
#include "tabor/core/rows.hpp"
#include "tabor/metrology/areal/spectral_moments.hpp"
#include "tabor/metrology/spectra/half_spectrum.hpp"
#include "tabor/numerics/field_statistics.hpp"
#include "tabor/spectral/fft.hpp"
#include "tabor/spectral/strips.hpp"

namespace tabor::metrology {
namespace {

constexpr Index kStrips = 4;  ///< the spectrum is made in so many parts: 2 bytes per pixel each

/// Periodic Hann window of n samples with unit mean square; ones for a periodic surface.
Eigen::ArrayXd window(Index n, bool periodic) {
  Eigen::ArrayXd weights = Eigen::ArrayXd::Ones(n);
  if (periodic || n < 3) return weights;
  for (Index i = 0; i < n; ++i) {
    const double phase = (static_cast<double>(i) + 0.5) / static_cast<double>(n);
    weights[i] = 1 - std::cos(2 * std::numbers::pi * phase);
  }
  return weights / std::sqrt(weights.square().mean());
}

using Sums = Eigen::Array<double, 6, 1>;  ///< m0, m2_x, m2_y, m4_x, m4_y, <(lap z)^2>

/// What the mode (qx, qy) of this power adds.
Sums of_mode(double power, double qx, double qy) {
  const double x2 = qx * qx, y2 = qy * qy;
  Sums sums;
  sums << 1, x2, y2, x2 * x2, y2 * y2, (x2 + y2) * (x2 + y2);
  return power * sums;
}

/// Sums over one column of the spectrum; frequency kx stands for -kx too.
Sums of_column(const std::complex<double>* column, Index kx, const Grid& grid) {
  const double qx = spectral::wavevector(kx, grid.nx, grid.lx);
  const double norm = multiplicity(kx, grid.nx) /
                      (static_cast<double>(grid.size()) * static_cast<double>(grid.size()));
  Sums sums = Sums::Zero();
  for (Index ky = kx == 0 ? 1 : 0; ky < grid.ny; ++ky) {
    sums += of_mode(norm * std::norm(column[ky]), qx, spectral::wavevector(ky, grid.ny, grid.ly));
  }
  return sums;
}

}  // namespace

SpectralMoments spectrum_moments(const topography::Topography& topography) {
  const Grid& grid = topography.grid;
  const double mean = numerics::field_moments(topography.height).mean;
  const Eigen::ArrayXd along_x = window(grid.nx, topography.periodic);
  const Eigen::ArrayXd along_y = window(grid.ny, topography.periodic);
  const spectral::StripTransform<double> transform(grid.ny, grid.nx, grid.ny, grid.nx);
  const auto row = [&](Index y, std::span<double> values) {
    for (Index x = 0; x < grid.nx; ++x) {
      values[static_cast<std::size_t>(x)] =
          (topography.height(y, x) - mean) * along_x[x] * along_y[y];
    }
  };
  const Index n = transform.n_frequencies(), width = (n + kStrips - 1) / kStrips;
  std::vector<Sums> columns(static_cast<std::size_t>(n), Sums::Zero());
  spectral::StripTransform<double>::Strip strip;
  for (Index begin = 0; begin < n; begin += width) {
    const spectral::ColumnRange range{begin, std::min(n, begin + width)};
    transform.rows_forward(row, range, strip);
    spectral::StripTransform<double>::Strip* const strips[] = {&strip};
    transform.read_columns(
        strips, range, [&](Index kx, std::span<std::complex<double>* const> of_maps) {
          columns[static_cast<std::size_t>(kx)] = of_column(of_maps[0], kx, grid);
        });
  }
  Sums total = Sums::Zero();
  for (const Sums& column : columns) total += column;
  return {.m0 = total[0],
          .m2_x = total[1],
          .m2_y = total[2],
          .m2 = (total[1] + total[2]) / 2,
          .m4_x = total[3],
          .m4_y = total[4],
          .m4 = 3.0 / 8 * total[5]};
}

}  // namespace tabor::metrology
