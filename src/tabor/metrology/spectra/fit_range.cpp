// Where a spectrum can be a power law.
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "tabor/metrology/spectra/log_bins.hpp"

namespace tabor::metrology {
namespace {

constexpr double kSure = 3;       ///< standard deviations beyond which nothing is chance
constexpr double kLeftOut = 0.1;  ///< what a gradual fall may have taken where the fit ends, in ln

/// Where the density begins to fall more steeply, over two bins and by more than chance, than
/// H = 1 plus one power.
double find_cut(const std::vector<Bin>& bins, double offset, double from) {
  constexpr std::size_t reach = 2;
  for (std::size_t i = 0; i + reach < bins.size(); ++i) {
    const Bin &first = bins[i], &last = bins[i + reach];
    const double width = last.log_q - first.log_q;
    const double slope = (last.log_density - first.log_density) / width;
    const double deviation = std::sqrt(first.variance + last.variance) / width;
    if (std::exp(first.log_q) > from && slope + kSure * deviation < -(offset + 3)) {
      return std::exp(first.log_q);
    }
  }
  return std::numeric_limits<double>::infinity();
}

using Point = std::vector<Bin>::const_iterator;

/// First point from `from` on that lies below the line by more than `fall`, and by more than
/// `deviations`.
Point first_below(const std::vector<Bin>& points, const Line& line, double from, double fall,
                  double deviations) {
  return std::find_if(points.begin(), points.end(), [&](const Bin& point) {
    const double deviation = std::sqrt(point.variance + line.variance_at(point.log_q));
    return std::exp(point.log_q) > from &&
           point.log_density < line(point.log_q) - fall - deviations * deviation;
  });
}

/// What bins lose beside a power law towards `edge`, in ln, if it rises as q^2 (a Gaussian filter).
struct Fall {
  double at_edge = 0;
  double deviation = std::numeric_limits<double>::infinity();
};

Fall fall_towards(double edge, const std::vector<Bin>& bins) {
  constexpr double least_variance = 4e-4;
  if (bins.size() < 5) return {};
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Zero(), scatter = matrix;
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (const Bin& bin : bins) {
    const double weight = 1 / (bin.variance + least_variance);
    const double x = bin.log_q - std::log(edge);
    const Eigen::Vector3d terms(1, x, std::exp(2 * x));
    matrix += weight * terms * terms.transpose();
    scatter += weight * weight * bin.variance * terms * terms.transpose();
    right += weight * bin.log_density * terms;
  }
  const Eigen::Matrix3d inverse = matrix.inverse();
  return {-(inverse * right)[2], std::sqrt((inverse * scatter * inverse)(2, 2))};
}

/// The end of the power law before the fall that was found at `cut`: the last point that is not
/// below the law of those before; if the fall is gradual, or seen before it, where it is small.
double end_before(const std::vector<Bin>& points, double q_min, double cut) {
  constexpr double before = 1.1, sharp = 1.1, few_points = 2.5;
  const double from = cut / before;
  const Line line = fit_line(log_bins(points, q_min, from));
  if (std::isnan(line.slope)) return cut / 2.5;
  const Point below = first_below(points, line, from, 0, kSure);
  const bool exists = below != points.end() && below != points.begin();
  const double edge = exists ? std::exp((below - 1)->log_q) : cut;
  const Point tenth = first_below(points, line, edge, std::log(10.0), 0);
  const double spacing = std::exp(points.front().log_q);
  const bool is_sharp =
      tenth != points.end() &&
      std::exp(tenth->log_q) <= std::max(sharp * edge, edge + few_points * spacing);
  const Fall fall = fall_towards(edge, log_bins(points, q_min, edge));
  if (is_sharp && !(fall.at_edge > kSure * fall.deviation)) return edge;
  return edge * std::min(1.0, std::sqrt(kLeftOut / std::max(fall.at_edge, fall.deviation)));
}

/// A narrow spectrum is fitted from nearer to its roll-off, never from below it.
double start_after(double roll_off, double q_max) {
  return std::min(2 * roll_off, std::max(roll_off, q_max / 3));
}

}  // namespace

FitRange find_fit_range(const Spectrum& spectrum, double offset) {
  const auto points = log_points(spectrum);
  if (points.empty()) return {};
  const auto bins = log_bins(points, spectrum.q.front(), spectrum.q.back());
  const auto peak = std::max_element(bins.begin(), bins.end(), [&](const Bin& a, const Bin& b) {
    return a.log_density + offset * a.log_q < b.log_density + offset * b.log_q;
  });
  const double roll_off = std::exp(peak->log_q);
  const double cut = find_cut(bins, offset, roll_off);
  double q_max = spectrum.q.back() / 2;
  if (cut < 2.5 * q_max) {
    const double q_min = start_after(roll_off, cut / 2.5);
    q_max = std::max(roll_off, std::min(q_max, end_before(points, q_min, cut)));
  }
  return {start_after(roll_off, q_max), q_max, roll_off};
}

}  // namespace tabor::metrology
