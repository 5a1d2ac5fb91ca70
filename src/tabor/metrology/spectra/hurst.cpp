#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "tabor/metrology/spectra/log_bins.hpp"
#include "tabor/metrology/spectra/psd.hpp"

namespace tabor::metrology {
namespace {

/// The points without what a window makes of a power law with this exponent.
std::vector<Bin> without_bias(const Spectrum& spectrum, std::vector<Bin> points,
                              const WindowBias& bias, double exponent) {
  if (!bias) return points;
  const std::vector<double> of_all = bias(exponent);
  std::size_t next = 0;
  for (std::size_t i = 0; i < spectrum.q.size(); ++i) {
    if (spectrum.density[i] > 0) points[next++].log_density -= of_all[i];
  }
  return points;
}

}  // namespace

HurstFit fit_hurst(const Spectrum& spectrum, double offset, double q_min, double q_max,
                   const WindowBias& bias) {
  constexpr int n_rounds = 4;  // the bias depends weakly on H
  const auto points = log_points(spectrum);
  HurstFit fit;
  fit.q_min = q_min;
  fit.q_max = q_max;
  double exponent = offset + 1.5;
  for (int round = 0; round < (bias ? n_rounds : 1); ++round) {
    const auto bins = log_bins(without_bias(spectrum, points, bias, exponent), q_min, q_max);
    const Line line = fit_line(bins);
    fit.n_bins = static_cast<int>(bins.size());
    if (std::isnan(line.slope)) return fit;
    fit.hurst = (-line.slope - offset) / 2;
    fit.standard_error = std::sqrt(line.slope_variance) / 2;
    exponent = std::clamp(-line.slope, offset - 1, offset + 3);
  }
  return fit;
}

HurstFit fit_hurst(const std::vector<double>& q, const std::vector<double>& density, double offset,
                   double q_min, double q_max) {
  Spectrum spectrum;
  spectrum.q = q;
  spectrum.density = density;
  return fit_hurst(spectrum, offset, q_min, q_max);
}

DifferenceHurst fit_hurst(const HeightDifference& differences, double mean_square) {
  DifferenceHurst result;
  result.hurst = result.standard_error = std::numeric_limits<double>::quiet_NaN();
  if (differences.lag.size() < 3) return result;
  std::size_t last = 1;
  while (last + 1 < differences.lag.size() &&
         differences.mean_square[last + 1] <= 0.2 * 2 * mean_square) {
    ++last;
  }
  result.lag_min = differences.lag[1];
  result.lag_max = differences.lag[last];
  // The slope over the inverse lag, rising like a wavevector.
  std::vector<double> inverse(differences.lag.rbegin(), differences.lag.rend());
  std::transform(inverse.begin(), inverse.end(), inverse.begin(), [](double r) { return 1 / r; });
  const std::vector<double> squares(differences.mean_square.rbegin(),
                                    differences.mean_square.rend());
  const HurstFit fit = fit_hurst(inverse, squares, 0, 1 / result.lag_max, 1 / result.lag_min);
  result.hurst = fit.hurst;
  result.standard_error = fit.standard_error;
  result.n_bins = fit.n_bins;
  return result;
}

}  // namespace tabor::metrology
