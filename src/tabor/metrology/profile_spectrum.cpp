#include "tabor/metrology/profile_spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "tabor/core/rows.hpp"
#include "tabor/metrology/half_spectrum.hpp"
#include "tabor/spectral/fft.hpp"

namespace tabor::metrology {
namespace {

using std::numbers::pi;
using ComplexField =
    Eigen::Array<std::complex<double>, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Adds of_row(y), an array of numbers, over all rows; blocks of rows in their order.
template <typename AddRow>
Eigen::ArrayXd accumulate_rows(Index n_rows, Index n_values, const AddRow& add_row) {
  constexpr Index block_rows = 64;
  std::vector<Eigen::ArrayXd> blocks(
      static_cast<std::size_t>((n_rows + block_rows - 1) / block_rows));
  parallel_for(n_rows, block_rows, [&](Index begin, Index end) {
    Eigen::ArrayXd& sums = blocks[static_cast<std::size_t>(begin / block_rows)];
    sums = Eigen::ArrayXd::Zero(n_values);
    for (Index y = begin; y < end; ++y) add_row(y, sums);
  });
  Eigen::ArrayXd total = Eigen::ArrayXd::Zero(n_values);
  for (const auto& block : blocks) total += block;
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

}  // namespace

Spectrum profile_spectrum(Index n_rows, Index n, double length, PsdWindow window,
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

}  // namespace tabor::metrology
