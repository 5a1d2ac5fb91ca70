#include "tabor/elastic/axisymmetric.hpp"

#include <fmt/format.h>

#include <array>
#include <cassert>
#include <cmath>
#include <numbers>
#include <utility>

#include "tabor/core/error.hpp"
#include "tabor/core/rows.hpp"
#include "tabor/reference/elliptic_integrals.hpp"

namespace tabor::elastic {
namespace {

using std::numbers::pi;

/// Returns the integrals of modulus k, 0 <= k < 1.
reference::EllipticIntegrals integrals_of(double k) {
  return reference::elliptic_integrals(k, std::sqrt((1 - k) * (1 + k)));
}

/// Points and weights of Gauss' rule with 8 points on (0, 1).
struct GaussPoint {
  double x;
  double weight;
};
constexpr std::array<GaussPoint, 8> kGauss{{{0.019855071751231884, 0.050614268145188129},
                                            {0.101666761293186630, 0.111190517226687235},
                                            {0.237233795041835507, 0.156853322938943643},
                                            {0.408282678752175098, 0.181341891689180991},
                                            {0.591717321247824902, 0.181341891689180991},
                                            {0.762766204958164493, 0.156853322938943643},
                                            {0.898333238706813370, 0.111190517226687235},
                                            {0.980144928248768116, 0.050614268145188129}}};

/// Integral over c from `from` to `to` of disc_displacement(r, c). Where r is one of the ends, the
/// integrand has a term x ln x there, x the distance; with x = t^2 the rule sees a smooth function.
double disc_integral(double r, double from, double to, double effective_modulus) {
  const bool singular_end = r == from || r == to;
  const double start = r == to ? to : from;
  const double length = r == to ? from - to : to - from;  // signed, away from `start`
  double sum = 0;
  for (const auto& [x, weight] : kGauss) {
    const double place = singular_end ? x * x : x;
    const double stretch = singular_end ? 2 * x : 1;
    sum += weight * stretch * disc_displacement(r, start + length * place, effective_modulus);
  }
  return sum * (to - from);
}

/// Row of the matrix for pressure uniform on rings: differences of discs.
void fill_uniform(double r, const Eigen::ArrayXd& edges, double modulus,
                  Eigen::Ref<Eigen::RowVectorXd> row) {
  double inner = 0;
  for (Index j = 0; j < row.size(); ++j) {
    const double outer = disc_displacement(r, edges[j + 1], modulus);
    row[j] = outer - inner;
    inner = outer;
  }
}

/// Row for pressure linear between nodes. A falling pressure is a pile of discs: the slope -dp/dc
/// is the pressure that ends at radius c.
void fill_linear(double r, const Eigen::ArrayXd& radii, double modulus,
                 Eigen::Ref<Eigen::RowVectorXd> row) {
  row.setZero();
  const Index last = radii.size() - 1;
  for (Index j = 0; j < last; ++j) {
    const double mean =
        disc_integral(r, radii[j], radii[j + 1], modulus) / (radii[j + 1] - radii[j]);
    row[j] += mean;
    row[j + 1] -= mean;
  }
  row[last] += disc_displacement(r, radii[last], modulus);
}

Eigen::ArrayXd uniform_weights(const Eigen::ArrayXd& edges) {
  const Index n = edges.size() - 1;
  return pi * (edges.tail(n).square() - edges.head(n).square());
}

Eigen::ArrayXd linear_weights(const Eigen::ArrayXd& radii) {
  Eigen::ArrayXd weights = Eigen::ArrayXd::Zero(radii.size());
  for (Index j = 0; j + 1 < radii.size(); ++j) {
    const double scale = pi / 3 * (radii[j + 1] - radii[j]);
    weights[j] += scale * (2 * radii[j] + radii[j + 1]);
    weights[j + 1] += scale * (radii[j] + 2 * radii[j + 1]);
  }
  return weights;
}

void check(const Eigen::ArrayXd& radii, double effective_modulus) {
  if (!(effective_modulus > 0) || !std::isfinite(effective_modulus)) {
    throw InputError("effective modulus", fmt::format("{} Pa", effective_modulus),
                     "a positive number", "check Young's modulus and Poisson's ratio");
  }
  const Index n = radii.size();
  const bool increasing = n >= 3 && radii[0] == 0 && (radii.tail(n - 1) > radii.head(n - 1)).all();
  if (!increasing || !std::isfinite(radii[n - 1])) {
    throw InputError("radii of an axisymmetric profile",
                     n < 3 ? fmt::format("{} of them", n) : "values out of order or not from 0",
                     "at least 3 radii, the first one 0, each larger than the one before", "");
  }
}

}  // namespace

double disc_displacement(double r, double c, double effective_modulus) {
  if (c == 0) return 0;
  const double scale = 4 / (pi * effective_modulus);
  if (r == c) return scale * c;
  if (r < c) return scale * c * integrals_of(r / c).second;
  const double k = c / r;
  return scale * c * k * integrals_of(k).narrow;
}

Eigen::ArrayXd uniform_radii(Index n, double r_max) { return graded_radii(n, r_max, 1); }

Eigen::ArrayXd graded_radii(Index n, double r_max, double spacing_ratio) {
  if (n < 3 || !(r_max > 0 && std::isfinite(r_max)) ||
      !(spacing_ratio > 0 && std::isfinite(spacing_ratio))) {
    throw InputError("radial grid",
                     fmt::format("{} nodes to {} m, spacing ratio {}", n, r_max, spacing_ratio),
                     "at least 3 nodes, a positive radius and a positive ratio", "");
  }
  const auto intervals = static_cast<double>(n - 1);
  const Eigen::ArrayXd place = Eigen::ArrayXd::LinSpaced(n, 0, intervals);
  // Spacings q^0 .. q^(n - 2) sum up to (q^i - 1) / (q - 1).
  const double log_growth = n > 2 ? std::log(spacing_ratio) / (intervals - 1) : 0;
  if (log_growth == 0) return r_max / intervals * place;
  Eigen::ArrayXd radii = r_max * (log_growth * place).unaryExpr([](double x) {
    return std::expm1(x);
  }) / std::expm1(log_growth * intervals);
  radii[n - 1] = r_max;
  return radii;
}

Eigen::ArrayXd ring_edges(const Eigen::ArrayXd& radii) {
  const Index n = radii.size();
  Eigen::ArrayXd edges(n + 1);
  edges[0] = 0;
  edges.segment(1, n - 1) = 0.5 * (radii.head(n - 1) + radii.tail(n - 1));
  edges[n] = radii[n - 1];
  return edges;
}

AxisymmetricHalfSpace::AxisymmetricHalfSpace(Eigen::ArrayXd radii, double effective_modulus,
                                             PressureShape shape)
    : radii_(std::move(radii)), effective_modulus_(effective_modulus) {
  check(radii_, effective_modulus_);
  const Index n = radii_.size();
  const Eigen::ArrayXd edges = ring_edges(radii_);
  const bool uniform = shape == PressureShape::uniform;
  load_weights_ = uniform ? uniform_weights(edges) : linear_weights(radii_);
  matrix_.resize(n, n);
  for_each_row(n, [&](Index i) {
    if (uniform) {
      fill_uniform(radii_[i], edges, effective_modulus_, matrix_.row(i));
    } else {
      fill_linear(radii_[i], radii_, effective_modulus_, matrix_.row(i));
    }
  });
}

void AxisymmetricHalfSpace::apply(std::span<const double> pressure,
                                  std::span<double> displacement) const {
  assert(static_cast<Index>(pressure.size()) == size() && displacement.size() == pressure.size());
  const Eigen::Map<const Eigen::VectorXd> p(pressure.data(), size());
  Eigen::Map<Eigen::VectorXd>(displacement.data(), size()).noalias() = matrix_ * p;
}

}  // namespace tabor::elastic
