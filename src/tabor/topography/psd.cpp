#include "tabor/topography/psd.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

#include "tabor/core/error.hpp"
#include "tabor/spectral/fft.hpp"
#include "tabor/topography/rows.hpp"

namespace tabor::topography {
namespace {

using std::numbers::pi;
using ComplexField =
    Eigen::Array<std::complex<double>, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

constexpr std::array<std::pair<std::string_view, PsdConvention>, 3> kConventions{
    {{"jacobs", PsdConvention::jacobs},
     {"persson", PsdConvention::persson},
     {"gwyddion", PsdConvention::gwyddion}}};
constexpr std::array<std::pair<std::string_view, PsdWindow>, 2> kWindows{
    {{"none", PsdWindow::none}, {"hann", PsdWindow::hann}}};

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
void prepare_rows(Field& map, PsdWindow window) {
  const Eigen::ArrayXd weights =
      window == PsdWindow::hann ? hann_window(map.cols()) : Eigen::ArrayXd::Ones(map.cols());
  for_each_row(map.rows(), [&](Index y) {
    const double mean = map.row(y).mean();
    map.row(y) = (map.row(y) - mean) * weights.transpose();
  });
}

/// Jacobs's C1D of the rows of `map`, `length` long: mean over rows of |dx FFT|^2 / L.
Spectrum row_spectrum(Field map, double length, PsdWindow window) {
  prepare_rows(map, window);
  const Index n = map.cols();
  ComplexField transform(map.rows(), n / 2 + 1);
  spectral::forward_rows(map, transform);
  const auto power = accumulate_rows(map.rows(), n / 2 + 1, [&](Index y, Eigen::ArrayXd& sums) {
    sums += transform.row(y).abs2().transpose();
  });
  const double dx = length / static_cast<double>(n);
  const double scale = dx * dx / (length * static_cast<double>(map.rows()));
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

/// Heights about their mean.
Field centred(const Field& height) {
  return height - sum(height) / static_cast<double>(height.size());
}

double mean_square(const Field& z) {
  return sum_over_rows<1>(
             z.rows(),
             [&](Index y) { return Eigen::Array<double, 1, 1>(z.row(y).square().sum()); })[0] /
         static_cast<double>(z.size());
}

/// Radially symmetric Hann window (Jacobs et al. 2017, section 3.2), unit mean square; an ellipse
/// on scans that are not square.
void apply_radial_window(Field& z) {
  const auto weight = [&](Index y, Index x) {
    const double u = (static_cast<double>(x) + 0.5) / static_cast<double>(z.cols()) - 0.5;
    const double v = (static_cast<double>(y) + 0.5) / static_cast<double>(z.rows()) - 0.5;
    const double r = std::hypot(u, v);
    return r < 0.5 ? 1 + std::cos(2 * pi * r) : 0;
  };
  const double square = sum_over_rows<1>(z.rows(), [&](Index y) {
    Eigen::Array<double, 1, 1> total = Eigen::Array<double, 1, 1>::Zero();
    for (Index x = 0; x < z.cols(); ++x) {
      total += weight(y, x) * weight(y, x);
    }
    return total;
  })[0];
  const double norm = std::sqrt(static_cast<double>(z.size()) / square);
  for_each_row(z.rows(), [&](Index y) {
    for (Index x = 0; x < z.cols(); ++x) {
      z(y, x) *= norm * weight(y, x);
    }
  });
}

/// Sums over the modes of a two-dimensional spectrum; rings of width dq.
struct RingSums {
  Eigen::ArrayXd modes, wavevectors, power;
  double variance = 0, slope_variance = 0;
};

RingSums ring_sums(const ComplexField& transform, const Grid& grid, double dq, Index n_rings) {
  const double norm = 1 / (static_cast<double>(grid.size()) * static_cast<double>(grid.size()));
  const auto sums = accumulate_rows(grid.ny, 3 * n_rings + 2, [&](Index ky, Eigen::ArrayXd& row) {
    const double qy = spectral::wavevector(ky, grid.ny, grid.ly);
    for (Index kx = 0; kx < transform.cols(); ++kx) {
      const double q = std::hypot(spectral::wavevector(kx, grid.nx, grid.lx), qy);
      const double count = q > 0 ? multiplicity(kx, grid.nx) : 0;
      const double power = count * norm * std::norm(transform(ky, kx));
      const auto ring = static_cast<Index>(std::llround(q / dq));
      if (ring < n_rings) {
        row[ring] += count;
        row[n_rings + ring] += count * q;
        row[2 * n_rings + ring] += power;
      }
      row[3 * n_rings] += power;
      row[3 * n_rings + 1] += q * q * power;
    }
  });
  return {sums.head(n_rings), sums.segment(n_rings, n_rings), sums.segment(2 * n_rings, n_rings),
          sums[3 * n_rings], sums[3 * n_rings + 1]};
}

/// Jacobs's C2D = |dx dy FFT2|^2 / (Lx Ly) averaged over rings, up to the smaller Nyquist
/// wavevector.
Spectrum radial_spectrum(const Field& z, const Grid& grid) {
  ComplexField transform(grid.ny, grid.nx / 2 + 1);
  spectral::RealFft2d<double>(grid.ny, grid.nx).forward(z.data(), transform.data());
  const double dq = 2 * pi / std::max(grid.lx, grid.ly);
  const double nyquist = pi / std::max(grid.dx(), grid.dy());
  const auto n_rings = static_cast<Index>(nyquist / dq * (1 + 1e-12)) + 1;
  const auto sums = ring_sums(transform, grid, dq, n_rings);
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

template <typename Table>
auto find(const Table& table, std::string_view name)
    -> std::optional<typename Table::value_type::second_type> {
  for (const auto& [known, value] : table) {
    if (known == name) {
      return value;
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<PsdConvention> psd_convention_from(std::string_view name) {
  return find(kConventions, name);
}
std::optional<PsdWindow> psd_window_from(std::string_view name) { return find(kWindows, name); }
std::string_view name_of(PsdConvention convention) {
  return kConventions[static_cast<std::size_t>(convention)].first;
}
std::string_view name_of(PsdWindow window) {
  return kWindows[static_cast<std::size_t>(window)].first;
}

PowerSpectra power_spectra(const Topography& topography, const PsdOptions& options) {
  check_complete(topography);
  const Grid& grid = topography.grid;
  PowerSpectra spectra;
  spectra.window = options.window.value_or(topography.periodic ? PsdWindow::none : PsdWindow::hann);
  spectra.x = row_spectrum(topography.height, grid.lx, spectra.window);
  spectra.y = row_spectrum(topography.height.transpose(), grid.ly, spectra.window);
  Field z = centred(topography.height);
  const double variance = mean_square(z);
  if (spectra.window == PsdWindow::hann) {
    apply_radial_window(z);
    spectra.window_gain = variance > 0 ? mean_square(z) / variance : 1;
  }
  spectra.radial = radial_spectrum(z, grid);
  spectra.rms_height = spectra.radial.rms_height;
  spectra.rms_slope = spectra.radial.rms_slope;
  fit(spectra.x, 1, options);
  fit(spectra.y, 1, options);
  fit(spectra.radial, 2, options);
  convert(spectra, options.convention);
  return spectra;
}

}  // namespace tabor::topography
