#include "tabor/metrology/spectra/profile_spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <numeric>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "tabor/metrology/spectra/half_spectrum.hpp"
#include "tabor/spectral/strips.hpp"

namespace tabor::metrology {
namespace {

using std::numbers::pi;
/// Periodic Hann window of n samples with unit mean square.
Eigen::ArrayXd hann_window(Index n) {
  Eigen::ArrayXd window(n);
  for (Index i = 0; i < n; ++i) {
    window[i] = 1 - std::cos(2 * pi * (static_cast<double>(i) + 0.5) / static_cast<double>(n));
  }
  return window / std::sqrt(window.square().mean());
}

/// Per frequency, sums over the rows of |FFT|^2 and the number of independent ones among them.
struct RowPower {
  Eigen::ArrayXd power, modes;
};

/// Power over the frequencies ky of one column of a two-dimensional spectrum: their sum, and how
/// many share it, by (sum P)^2 / sum P^2, whose expectation is (number + 1)/2 for exponential P.
std::pair<double, double> sum_of_column(const std::complex<double>* column, Index n) {
  double sum = 0, squares = 0;
  for (Index ky = 0; ky < n; ++ky) {
    const double power = std::norm(column[ky]);
    sum += power;
    squares += power * power;
  }
  return {sum / static_cast<double>(n),
          squares > 0 ? std::max(1.0, 2 * sum * sum / squares - 1) : 1};
}

/// Transforms a part of the frequencies at a time, as memory does not suffice for long scans.
RowPower row_power(Index n_rows, Index n, const Eigen::ArrayXd& weights, const RowOf& row_of) {
  constexpr Index n_strips = 4;
  RowPower result{Eigen::ArrayXd::Zero(n / 2 + 1), Eigen::ArrayXd::Ones(n / 2 + 1)};
  const spectral::StripTransform<double> transform(n_rows, n, n_rows, n);
  const auto row = [&](Index y, std::span<double> values) {
    row_of(y, values);
    // Eigen's sums begin at an aligned element: where the row lies would decide about the last bit.
    const double mean = std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(n);
    Eigen::Map<Eigen::ArrayXd> z(values.data(), n);
    z = (z - mean) * weights;
  };
  const Index width = (n / 2 + n_strips) / n_strips;
  spectral::StripTransform<double>::Strip strip;
  for (Index begin = 0; begin <= n / 2; begin += width) {
    const spectral::ColumnRange range{begin, std::min(n / 2 + 1, begin + width)};
    transform.rows_forward(row, range, strip);
    spectral::StripTransform<double>::Strip* const strips[] = {&strip};
    transform.read_columns(
        strips, range, [&](Index kx, std::span<std::complex<double>* const> columns) {
          std::tie(result.power[kx], result.modes[kx]) = sum_of_column(columns[0], n_rows);
        });
  }
  return result;
}

}  // namespace

Spectrum profile_spectrum(Index n_rows, Index n, double length, PsdWindow window,
                          const RowOf& row_of) {
  const Eigen::ArrayXd weights =
      window == PsdWindow::hann ? hann_window(n) : Eigen::ArrayXd::Ones(n);
  const auto [power, modes] = row_power(n_rows, n, weights, row_of);
  const double dx = length / static_cast<double>(n);
  const double scale = dx * dx / (length * static_cast<double>(n_rows));
  Spectrum spectrum;
  double variance = 0, slope_variance = 0;
  for (Index k = 1; k <= n / 2; ++k) {
    const double q = 2 * pi * static_cast<double>(k) / length;
    spectrum.q.push_back(q);
    spectrum.density.push_back(scale * power[k]);
    spectrum.modes.push_back(2 * k == n ? modes[k] / 2 : modes[k]);  // real at the last frequency
    variance += multiplicity(k, n) * scale * power[k] / length;
    slope_variance += multiplicity(k, n) * q * q * scale * power[k] / length;
  }
  spectrum.mode_spread = weights.pow(4).mean();
  spectrum.rms_height = std::sqrt(variance);
  spectrum.rms_slope = std::sqrt(slope_variance);
  return spectrum;
}

}  // namespace tabor::metrology
