#include "tabor/metrology/spectra/radial_spectrum.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <span>
#include <vector>

#include "tabor/core/rows.hpp"
#include "tabor/metrology/spectra/half_spectrum.hpp"
#include "tabor/spectral/fft.hpp"
#include "tabor/spectral/strips.hpp"

namespace tabor::metrology {
namespace {

using std::numbers::pi;

/// Radially symmetric Hann window (Jacobs et al. 2017, section 3.2) before scaling; an ellipse on
/// scans that are not square.
double radial_hann(const Grid& grid, Index y, Index x) {
  const double u = (static_cast<double>(x) + 0.5) / static_cast<double>(grid.nx) - 0.5;
  const double v = (static_cast<double>(y) + 0.5) / static_cast<double>(grid.ny) - 0.5;
  const double r = std::hypot(u, v);
  return r < 0.5 ? 1 + std::cos(2 * pi * r) : 0;
}

/// Mean of of_pixel(y, x) over the grid.
template <typename OfPixel>
double mean_over(const Grid& grid, const OfPixel& of_pixel) {
  return sum_over_rows<1>(grid.ny,
                          [&](Index y) {
                            Eigen::Array<double, 1, 1> total = Eigen::Array<double, 1, 1>::Zero();
                            for (Index x = 0; x < grid.nx; ++x) total += of_pixel(y, x);
                            return total;
                          })[0] /
         static_cast<double>(grid.size());
}

/// Heights about their mean times the window of unit mean square, made when they are needed.
class WindowedHeights {
 public:
  WindowedHeights(const Field& height, const Grid& grid, PsdWindow window)
      : height_(height),
        grid_(grid),
        mean_(sum(height) / static_cast<double>(height.size())),
        is_windowed_(window == PsdWindow::hann) {
    if (is_windowed_) {
      const auto square = [&](Index y, Index x) {
        return radial_hann(grid_, y, x) * radial_hann(grid_, y, x);
      };
      scale_ = 1 / std::sqrt(mean_over(grid_, square));
    }
  }

  double operator()(Index y, Index x) const {
    const double z = height_(y, x) - mean_;
    return is_windowed_ ? z * (scale_ * radial_hann(grid_, y, x)) : z;
  }

  /// By how much the window raises the variance of a sum of power over many modes: neighbouring
  /// ones are no longer independent.
  double mode_spread() const {
    return is_windowed_ ? mean_over(grid_,
                                    [&](Index y, Index x) {
                                      return std::pow(scale_ * radial_hann(grid_, y, x), 4);
                                    })
                        : 1;
  }

 private:
  const Field& height_;
  Grid grid_;
  double mean_;
  bool is_windowed_;
  double scale_ = 1;
};

/// Sums over the modes of a two-dimensional spectrum; rings of width dq.
struct RingSums {
  Eigen::ArrayXd modes, wavevectors, power;
  double variance = 0, slope_variance = 0;
};

/// Adds the modes of one column of the half spectrum to sums over modes, wavevectors and power of
/// each ring, then variance and slope variance.
void add_column(const Grid& grid, Index kx, const std::complex<double>* column, double dq,
                Index n_rings, Eigen::ArrayXd& sums) {
  const double norm = 1 / (static_cast<double>(grid.size()) * static_cast<double>(grid.size()));
  const double qx = spectral::wavevector(kx, grid.nx, grid.lx);
  for (Index ky = 0; ky < grid.ny; ++ky) {
    const double q = std::hypot(qx, spectral::wavevector(ky, grid.ny, grid.ly));
    const double count = q > 0 ? multiplicity(kx, grid.nx) : 0;
    const double power = count * norm * std::norm(column[ky]);
    const auto ring = static_cast<Index>(std::llround(q / dq));
    if (ring < n_rings) {
      sums[ring] += count;
      sums[n_rings + ring] += count * q;
      sums[2 * n_rings + ring] += power;
    }
    sums[3 * n_rings] += power;
    sums[3 * n_rings + 1] += q * q * power;
  }
}

/// Makes windowed heights row by row: beside the spectrum, memory does not suffice for their map.
RingSums ring_sums(const WindowedHeights& heights, const Grid& grid, double dq, Index n_rings) {
  const spectral::StripTransform<double> transform(grid.ny, grid.nx, grid.ny, grid.nx);
  const spectral::ColumnRange all{0, transform.n_frequencies()};
  std::vector<std::complex<double>> spectrum;
  const auto rows = [&](Index y, std::span<double> row) {
    for (std::size_t x = 0; x < row.size(); ++x) row[x] = heights(y, static_cast<Index>(x));
  };
  transform.rows_forward(rows, all, spectrum);
  constexpr Index block = spectral::kColumnsPerStripBlock;
  std::vector<Eigen::ArrayXd> blocks(static_cast<std::size_t>((all.size() + block - 1) / block),
                                     Eigen::ArrayXd::Zero(3 * n_rings + 2));
  const std::array strips{&spectrum};
  transform.read_columns(
      strips, all, [&](Index kx, std::span<std::complex<double>* const> columns) {
        add_column(grid, kx, columns[0], dq, n_rings, blocks[static_cast<std::size_t>(kx / block)]);
      });
  Eigen::ArrayXd total = Eigen::ArrayXd::Zero(3 * n_rings + 2);
  for (const auto& sums : blocks) total += sums;
  return {total.head(n_rings), total.segment(n_rings, n_rings), total.segment(2 * n_rings, n_rings),
          total[3 * n_rings], total[3 * n_rings + 1]};
}

}  // namespace

Spectrum radial_spectrum(const Field& height, const Grid& grid, PsdWindow window) {
  const WindowedHeights heights(height, grid, window);
  const double dq = 2 * pi / std::max(grid.lx, grid.ly);
  const double nyquist = pi / std::max(grid.dx(), grid.dy());
  const auto n_rings = static_cast<Index>(nyquist / dq * (1 + 1e-12)) + 1;
  const auto sums = ring_sums(heights, grid, dq, n_rings);
  Spectrum spectrum;
  for (Index ring = 1; ring < n_rings; ++ring) {
    if (sums.modes[ring] > 0) {
      spectrum.q.push_back(sums.wavevectors[ring] / sums.modes[ring]);
      spectrum.density.push_back(grid.area() * sums.power[ring] / sums.modes[ring]);
      spectrum.modes.push_back(std::max(0.5, sums.modes[ring] / 2));  // q and -q are one
    }
  }
  spectrum.mode_spread = heights.mode_spread();
  spectrum.rms_height = std::sqrt(sums.variance);
  spectrum.rms_slope = std::sqrt(sums.slope_variance);
  return spectrum;
}

}  // namespace tabor::metrology
