#include "tabor/metrology/spectra/log_bins.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tabor::metrology {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kLeastVariance = 0.01;  ///< no bin weighs as if it were known to better than 0.1

/// Digamma(m) - ln m, by its asymptotic series from 6 on and the recurrence below.
double log_bias(double m) {
  double shifted = m, digamma = 0;
  for (; shifted < 6; shifted += 1) digamma -= 1 / shifted;
  const double inverse = 1 / (shifted * shifted);
  digamma += std::log(shifted) - 0.5 / shifted -
             inverse * (1.0 / 12 - inverse * (1.0 / 120 - inverse / 252));
  return digamma - std::log(m);
}

/// Trigamma(m): the variance of the log of a gamma variable of shape m.
double log_variance(double m) {
  double trigamma = 0;
  for (; m < 6; m += 1) trigamma += 1 / (m * m);
  const double inverse = 1 / (m * m);
  return trigamma + 1 / m + inverse / 2 +
         inverse / m * (1.0 / 6 - inverse * (1.0 / 30 - inverse / 42));
}

/// Weight of a point beside others of its kind.
double weight_of(const Bin& bin) { return bin.variance > 0 ? 1 / bin.variance : 1; }

struct Sums {
  double weight = 0, x = 0, y = 0;
  void add(const Bin& bin, double w) {
    weight += w;
    x += w * (bin.log_q - x) / weight;
    y += w * (bin.log_density - y) / weight;
  }
};

/// By how much the bins scatter about the line more than chance allows, as a factor of variances.
double misfit(const std::vector<Bin>& bins, const Line& line) {
  double chi_square = 0;
  for (const Bin& bin : bins) {
    const double rest = bin.log_density - line(bin.log_q);
    chi_square += rest * rest / bin.variance;
  }
  const double freedom = static_cast<double>(bins.size()) - 2;
  return std::max(1.0, chi_square / freedom / (1 + 2 * std::sqrt(2 / freedom)));
}

/// Mean square distance of the bins from the line.
double scatter(const std::vector<Bin>& bins, const Line& line) {
  double squares = 0;
  for (const Bin& bin : bins) squares += std::pow(bin.log_density - line(bin.log_q), 2);
  return squares / (static_cast<double>(bins.size()) - 2);
}

}  // namespace

std::vector<Bin> log_points(const Spectrum& spectrum) {
  std::vector<Bin> points;
  const bool knows_modes = spectrum.modes.size() == spectrum.q.size();
  for (std::size_t i = 0; i < spectrum.q.size(); ++i) {
    if (!(spectrum.density[i] > 0)) continue;
    const double log_q = std::log(spectrum.q[i]), log_density = std::log(spectrum.density[i]);
    if (!knows_modes) {
      points.push_back({log_q, log_density, 0});
      continue;
    }
    const double modes = spectrum.modes[i];
    points.push_back(
        {log_q, log_density - log_bias(modes), log_variance(modes) * spectrum.mode_spread});
  }
  return points;
}

std::vector<Bin> log_bins(const std::vector<Bin>& points, double q_min, double q_max) {
  std::vector<Bin> bins;
  Sums sums;
  double current = -1;
  for (const Bin& point : points) {
    const double q = std::exp(point.log_q);
    if (q < q_min * (1 - 1e-12) || q > q_max * (1 + 1e-12)) continue;
    const double index =
        std::floor(kBinsPerDecade * (point.log_q - std::log(q_min)) / std::log(10.0) + 1e-9);
    if (index != current || bins.empty()) {
      bins.emplace_back();
      sums = {};
      current = index;
    }
    sums.add(point, weight_of(point));
    bins.back() = {sums.x, sums.y, point.variance > 0 ? 1 / sums.weight : 0};
  }
  return bins;
}

Line fit_line(const std::vector<Bin>& bins) {
  if (bins.size() < 3) return {kNan, kNan, kNan, kNan, kNan};
  const bool knows_variance = bins.front().variance > 0;
  const auto weight = [](const Bin& bin) { return 1 / (bin.variance + kLeastVariance); };
  Sums sums;
  for (const Bin& bin : bins) sums.add(bin, weight(bin));
  Line line{.centre = sums.x, .level = sums.y};
  double xx = 0, xy = 0, slope_variance = 0, level_variance = 0;
  for (const Bin& bin : bins) {
    const double x = bin.log_q - line.centre, w = weight(bin);
    xx += w * x * x;
    xy += w * x * bin.log_density;
    slope_variance += w * w * x * x * bin.variance;
    level_variance += w * w * bin.variance;
  }
  line.slope = xy / xx;
  if (knows_variance) {
    const double more = misfit(bins, line);
    line.slope_variance = more * slope_variance / (xx * xx);
    line.level_variance = more * level_variance / (sums.weight * sums.weight);
  } else {
    const double mean_square = scatter(bins, line) / kLeastVariance;  // the weights' own unit
    line.slope_variance = mean_square / xx;
    line.level_variance = mean_square / sums.weight;
  }
  return line;
}

}  // namespace tabor::metrology
