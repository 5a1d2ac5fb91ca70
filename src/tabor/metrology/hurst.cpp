#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "tabor/metrology/psd.hpp"

namespace tabor::metrology {
namespace {

constexpr double kBinsPerDecade = 12;

/// Mean log q and log density of the points in one logarithmic bin.
struct Bin {
  double log_q = 0;
  double log_density = 0;
};

std::vector<Bin> log_bins(const std::vector<double>& q, const std::vector<double>& density,
                          double q_min, double q_max) {
  std::vector<Bin> bins;
  double number = 0, current = -1;
  for (std::size_t i = 0; i < q.size(); ++i) {
    if (q[i] < q_min || q[i] > q_max || !(density[i] > 0)) continue;
    const double index = std::floor(kBinsPerDecade * std::log10(q[i] / q_min));
    if (index != current || bins.empty()) {
      bins.emplace_back();
      number = 0;
      current = index;
    }
    number += 1;
    bins.back().log_q += (std::log(q[i]) - bins.back().log_q) / number;
    bins.back().log_density += (std::log(density[i]) - bins.back().log_density) / number;
  }
  return bins;
}

struct Line {
  double slope = std::numeric_limits<double>::quiet_NaN();
  double standard_error = std::numeric_limits<double>::quiet_NaN();
};

Line fit_line(const std::vector<Bin>& bins) {
  const auto n = static_cast<double>(bins.size());
  double mean_x = 0, mean_y = 0, xx = 0, xy = 0, yy = 0;
  for (const Bin& bin : bins) {
    mean_x += bin.log_q / n;
    mean_y += bin.log_density / n;
  }
  for (const Bin& bin : bins) {
    xx += (bin.log_q - mean_x) * (bin.log_q - mean_x);
    xy += (bin.log_q - mean_x) * (bin.log_density - mean_y);
    yy += (bin.log_density - mean_y) * (bin.log_density - mean_y);
  }
  const double slope = xy / xx;
  const double scatter = std::max(0.0, yy - slope * xy) / (n - 2);
  return {slope, std::sqrt(scatter / xx)};
}

/// First q from which the density falls more steeply, over half a decade (less at the end of the
/// spectrum, where bins hold many modes), than H = 1 plus one power.
double find_cut(const std::vector<Bin>& bins, double offset, double from) {
  const auto reach = static_cast<std::size_t>(kBinsPerDecade / 2);
  for (std::size_t i = 0; i + reach / 2 < bins.size(); ++i) {
    const Bin& last = bins[std::min(i + reach, bins.size() - 1)];
    const double slope = (last.log_density - bins[i].log_density) / (last.log_q - bins[i].log_q);
    if (std::exp(bins[i].log_q) > from && slope < -(offset + 3)) return std::exp(bins[i].log_q);
  }
  return std::numeric_limits<double>::infinity();
}

}  // namespace

HurstFit fit_hurst(const std::vector<double>& q, const std::vector<double>& density, double offset,
                   double q_min, double q_max) {
  const auto bins = log_bins(q, density, q_min, q_max);
  const Line line = bins.size() >= 3 ? fit_line(bins) : Line{};
  HurstFit fit;
  fit.hurst = (-line.slope - offset) / 2;
  fit.standard_error = line.standard_error / 2;
  fit.q_min = q_min;
  fit.q_max = q_max;
  fit.n_bins = static_cast<int>(bins.size());
  return fit;
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

FitRange find_fit_range(const std::vector<double>& q, const std::vector<double>& density,
                        double offset) {
  if (q.empty()) return {};
  const auto bins = log_bins(q, density, q.front(), q.back());
  const auto peak = std::max_element(bins.begin(), bins.end(), [&](const Bin& a, const Bin& b) {
    return a.log_density + offset * a.log_q < b.log_density + offset * b.log_q;
  });
  const double roll_off = peak == bins.end() ? q.front() : std::exp(peak->log_q);
  const double cut = find_cut(bins, offset, roll_off);
  const double q_max = std::min(q.back() / 2, cut / 2.5);
  // A narrow spectrum is fitted from nearer to its roll-off, never from below it.
  return {std::min(2 * roll_off, std::max(roll_off, q_max / 3)), q_max};
}

}  // namespace tabor::metrology
