#include "tabor/topography/psd.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

#include "tabor/core/error.hpp"
#include "tabor/core/names.hpp"
#include "tabor/spectral/fft.hpp"
#include "tabor/spectral/strips.hpp"
#include "tabor/topography/rows.hpp"

namespace tabor::topography {
namespace {

using std::numbers::pi;
using ComplexField =
    Eigen::Array<std::complex<double>, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

constexpr auto kConventions = names<PsdConvention>("jacobs", "persson", "gwyddion");
constexpr auto kWindows = names<PsdWindow>("none", "hann");

/// How often frequency k of a half spectrum of n samples occurs in the full one.
double multiplicity(Index k, Index n) { return k == 0 || 2 * k == n ? 1 : 2; }

/// Adds of_row(y), an array of numbers, over all rows; blocks of rows in their order.
template <typename AddRow>
Eigen::ArrayXd accumulate_rows(Index n_rows, Index n_values, const AddRow& add_row) {
  constexpr Index block_rows = 64;
  std::vector<Eigen::ArrayXd> blocks(
      static_cast<std::size_t>((n_rows + block_rows - 1) / block_rows));
  parallel_for(n_rows, block_rows, [&](Index begin, Index end) {
    Eigen::ArrayXd& sums = blocks[static_cast<std::size_t>(begin / block_rows)];
    sums = Eigen::ArrayXd::Zero(n_values);
    for (Index y = begin; y < end; ++y) {
      add_row(y, sums);
    }
  });
  Eigen::ArrayXd total = Eigen::ArrayXd::Zero(n_values);
  for (const auto& block : blocks) {
    total += block;
  }
  return total;
}

/// Periodic Hann window of n samples with unit mean square.
Eigen::ArrayXd hann_window(Index n) {
  Eigen::ArrayXd window(n);
  for (Index i = 0; i < n; ++i) {
    window[i] = 1 - std::cos(2 * pi * (static_cast<double>(i) + 0.5) / static_cast<double>(n));
  }
  return window / std::sqrt(window.square().mean());
}

/// Rows about their own mean, times the window.
void prepare_rows(Field& map, const Eigen::ArrayXd& weights) {
  for_each_row(map.rows(), [&](Index y) {
    const double mean = map.row(y).mean();
    map.row(y) = (map.row(y) - mean) * weights.transpose();
  });
}

/// Sums over rows of |FFT|^2, a part of the rows at a time: long scans leave no room for more.
template <typename RowsOf>
Eigen::ArrayXd row_power(Index n_rows, Index n, const Eigen::ArrayXd& weights,
                         const RowsOf& rows_of) {
  constexpr Index rows_at_a_time = 1024;
  Eigen::ArrayXd power = Eigen::ArrayXd::Zero(n / 2 + 1);
  ComplexField transform;
  for (Index begin = 0; begin < n_rows; begin += rows_at_a_time) {
    Field part = rows_of(begin, std::min(rows_at_a_time, n_rows - begin));
    prepare_rows(part, weights);
    spectral::forward_rows(part, transform);
    power += accumulate_rows(part.rows(), n / 2 + 1, [&](Index y, Eigen::ArrayXd& sums) {
      sums += transform.row(y).abs2().transpose();
    });
  }
  return power;
}

/// Jacobs's C1D of `n_rows` rows of n pixels, `length` long: mean over rows of |dx FFT|^2 / L.
/// rows_of(first, count) returns some of them.
template <typename RowsOf>
Spectrum row_spectrum(Index n_rows, Index n, double length, PsdWindow window,
                      const RowsOf& rows_of) {
  const Eigen::ArrayXd weights =
      window == PsdWindow::hann ? hann_window(n) : Eigen::ArrayXd::Ones(n);
  const Eigen::ArrayXd power = row_power(n_rows, n, weights, rows_of);
  const double dx = length / static_cast<double>(n);
  const double scale = dx * dx / (length * static_cast<double>(n_rows));
  Spectrum spectrum;
  double variance = 0, slope_variance = 0;
  for (Index k = 1; k <= n / 2; ++k) {
    const double q = 2 * pi * static_cast<double>(k) / length;
    spectrum.q.push_back(q);
    spectrum.density.push_back(scale * power[k]);
    variance += multiplicity(k, n) * scale * power[k] / length;
    slope_variance += multiplicity(k, n) * q * q * scale * power[k] / length;
  }
  spectrum.rms_height = std::sqrt(variance);
  spectrum.rms_slope = std::sqrt(slope_variance);
  return spectrum;
}

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
                            for (Index x = 0; x < grid.nx; ++x) {
                              total += of_pixel(y, x);
                            }
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

  /// Mean square with the window over that without.
  double gain() const {
    const double before =
        mean_over(grid_, [&](Index y, Index x) { return std::pow(height_(y, x) - mean_, 2); });
    const double after =
        mean_over(grid_, [&](Index y, Index x) { return std::pow((*this)(y, x), 2); });
    return is_windowed_ && before > 0 ? after / before : 1;
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

/// Windowed heights are made row by row: beside the spectrum there is no room for a map of them.
RingSums ring_sums(const WindowedHeights& heights, const Grid& grid, double dq, Index n_rings) {
  const spectral::StripTransform<double> transform(grid.ny, grid.nx, grid.ny, grid.nx);
  const spectral::ColumnRange all{0, transform.n_frequencies()};
  std::vector<std::complex<double>> spectrum;
  const auto rows = [&](Index y, std::span<double> row) {
    for (std::size_t x = 0; x < row.size(); ++x) {
      row[x] = heights(y, static_cast<Index>(x));
    }
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
  for (const auto& sums : blocks) {
    total += sums;
  }
  return {total.head(n_rings), total.segment(n_rings, n_rings), total.segment(2 * n_rings, n_rings),
          total[3 * n_rings], total[3 * n_rings + 1]};
}

/// Jacobs's C2D = |dx dy FFT2|^2 / (Lx Ly) averaged over rings, up to the smaller Nyquist
/// wavevector.
Spectrum radial_spectrum(const WindowedHeights& heights, const Grid& grid) {
  const double dq = 2 * pi / std::max(grid.lx, grid.ly);
  const double nyquist = pi / std::max(grid.dx(), grid.dy());
  const auto n_rings = static_cast<Index>(nyquist / dq * (1 + 1e-12)) + 1;
  const auto sums = ring_sums(heights, grid, dq, n_rings);
  Spectrum spectrum;
  for (Index ring = 1; ring < n_rings; ++ring) {
    if (sums.modes[ring] > 0) {
      spectrum.q.push_back(sums.wavevectors[ring] / sums.modes[ring]);
      spectrum.density.push_back(grid.area() * sums.power[ring] / sums.modes[ring]);
    }
  }
  spectrum.rms_height = std::sqrt(sums.variance);
  spectrum.rms_slope = std::sqrt(sums.slope_variance);
  return spectrum;
}

void fit(Spectrum& spectrum, double offset, const PsdOptions& options) {
  const auto range = find_fit_range(spectrum.q, spectrum.density, offset);
  spectrum.hurst =
      fit_hurst(spectrum.q, spectrum.density, offset, options.fit_q_min.value_or(range.q_min),
                options.fit_q_max.value_or(range.q_max));
}

void convert(PowerSpectra& spectra, PsdConvention convention) {
  spectra.convention = convention;
  spectra.x.unit = spectra.y.unit = "m^3";
  spectra.radial.unit = convention == PsdConvention::gwyddion ? "m^3" : "m^4";
  if (convention == PsdConvention::jacobs) {
    return;
  }
  for (Spectrum* line : {&spectra.x, &spectra.y}) {
    for (double& density : line->density) {
      density /= 2 * pi;
    }
  }
  for (std::size_t i = 0; i < spectra.radial.q.size(); ++i) {
    const bool persson = convention == PsdConvention::persson;
    spectra.radial.density[i] *= persson ? 1 / (4 * pi * pi) : spectra.radial.q[i] / (2 * pi);
  }
}

void check_complete(const Topography& topography) {
  const Index n_missing = count_holes(topography);
  if (n_missing > 0) {
    throw InputError("power spectrum", fmt::format("{} missing heights", n_missing),
                     "a surface without holes", "fill them first (--fill harmonic)");
  }
  if (topography.grid.nx < 2 || topography.grid.ny < 2) {
    throw InputError("power spectrum",
                     fmt::format("{} x {} pixels", topography.grid.nx, topography.grid.ny),
                     "at least 2 x 2 pixels", "");
  }
}

}  // namespace

std::optional<PsdConvention> psd_convention_from(std::string_view name) {
  return kConventions.find(name);
}
std::optional<PsdWindow> psd_window_from(std::string_view name) { return kWindows.find(name); }
std::string_view name_of(PsdConvention convention) { return kConventions.of(convention); }
std::string_view name_of(PsdWindow window) { return kWindows.of(window); }

PowerSpectra power_spectra(const Topography& topography, const PsdOptions& options) {
  check_complete(topography);
  const Grid& grid = topography.grid;
  PowerSpectra spectra;
  spectra.window = options.window.value_or(topography.periodic ? PsdWindow::none : PsdWindow::hann);
  const Field& height = topography.height;
  spectra.x = row_spectrum(
      grid.ny, grid.nx, grid.lx, spectra.window,
      [&](Index begin, Index count) -> Field { return height.middleRows(begin, count); });
  spectra.y = row_spectrum(grid.nx, grid.ny, grid.ly, spectra.window,
                           [&](Index begin, Index count) -> Field {
                             return height.middleCols(begin, count).transpose();
                           });
  const WindowedHeights heights(height, grid, spectra.window);
  spectra.window_gain = heights.gain();
  spectra.radial = radial_spectrum(heights, grid);
  spectra.rms_height = spectra.radial.rms_height;
  spectra.rms_slope = spectra.radial.rms_slope;
  fit(spectra.x, 1, options);
  fit(spectra.y, 1, options);
  fit(spectra.radial, 2, options);
  convert(spectra, options.convention);
  return spectra;
}

}  // namespace tabor::topography
