#include "tabor/forming/darmstad.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>

#include "tabor/numerics/small_matrices.hpp"

namespace tabor::forming {
namespace {

constexpr int kPerDecade = 3;       // of the search for decays
constexpr double kSlowest = 1;      // decay over the largest speed: slower ones end far beyond it
constexpr double kFastest = 10;     // decay over the least speed: faster ones are over before it
constexpr double kFinest = 1.0005;  // factor at which the search ends
constexpr double kBetter = 1 - 1e-9;
constexpr Eigen::Index kUnknowns = 7;  // of the law

/// e^(-decay v) of the terms with p^2, with p, and with neither.
using Decays = std::array<double, 3>;

/// The numbers, pressures and speeds as shares of the largest.
struct Points {
  Eigen::VectorXd pressure;
  Eigen::VectorXd speed;
  Eigen::VectorXd friction;
  double pressure_scale = 1;  ///< [Pa]
  double speed_scale = 1;     ///< [m/s]
  std::size_t n_pressures = 0;
  double least_speed = 1;   ///< above zero, a share of the largest
  bool has_speeds = false;  ///< two or more
};

Points points_of(const DensityLayer& layer) {
  std::vector<FrictionEntry> all;
  for (const PressureRow& row : layer.rows) {
    all.insert(all.end(), row.entries.begin(), row.entries.end());
  }
  const auto n = static_cast<Eigen::Index>(all.size());
  Points points{Eigen::VectorXd(n), Eigen::VectorXd(n), Eigen::VectorXd(n)};
  for (Eigen::Index i = 0; i < n; ++i) {
    const FrictionEntry& entry = all[static_cast<std::size_t>(i)];
    points.pressure[i] = entry.at.mean_pressure;
    points.speed[i] = entry.at.sliding_speed.value_or(0);
    points.friction[i] = entry.friction;
  }
  points.n_pressures = layer.rows.size();
  points.has_speeds = points.speed.minCoeff() < points.speed.maxCoeff();
  points.pressure_scale = points.pressure.maxCoeff();
  points.pressure /= points.pressure_scale;
  if (!points.has_speeds) return points;
  points.speed_scale = points.speed.maxCoeff();
  points.speed /= points.speed_scale;
  for (const double speed : points.speed) {
    if (speed > 0) points.least_speed = std::min(points.least_speed, speed);
  }
  return points;
}

/// Factors of 1, p^2 e^(..), p e^(..), e^(..), and the sum of squares that they leave.
struct Linear {
  Eigen::Vector4d factors;
  double squares = 0;
};

/// Given the decays the law is linear.
Linear solve(const Points& points, const Decays& decays) {
  const auto decayed = [&](double decay) { return (-decay * points.speed.array()).exp(); };
  Eigen::MatrixX4d terms = Eigen::MatrixX4d::Zero(points.friction.size(), 4);
  terms.col(0).setOnes();
  if (points.n_pressures > 2) terms.col(1) = points.pressure.array().square() * decayed(decays[0]);
  terms.col(2) = points.pressure.array() * decayed(decays[1]);
  if (decays[2] > 0) terms.col(3) = decayed(decays[2]);  // otherwise another constant
  Linear linear;
  linear.factors = numerics::shortest_least_squares(terms, points.friction);
  linear.squares = (terms * linear.factors - points.friction).squaredNorm();
  return linear;
}

double fastest_decay(const Points& points) { return kFastest / points.least_speed; }

struct Search {
  const Points& points;
  Decays decays{};
  Linear best;

  explicit Search(const Points& all) : points(all), best(solve(all, {})) {}

  /// With fewer numbers than unknowns the terms share one decay.
  bool shares() const { return points.friction.size() <= kUnknowns; }

  bool is_allowed(const Decays& tried) const {
    double shared = 0;
    for (const double decay : tried) {
      if (decay == 0) continue;
      if (decay < kSlowest || decay > fastest_decay(points)) return false;
      if (shares() && shared != 0 && decay != shared) return false;
      shared = decay;
    }
    return true;
  }

  /// Takes over decays that leave clearly less; of equals the first stays, which is the simplest.
  bool accept(const Decays& tried) {
    if (!is_allowed(tried)) return false;
    const Linear linear = solve(points, tried);
    constexpr double kExact = 1e-26;  // of friction squared: rounding
    if (best.squares < kExact || !(linear.squares < kBetter * best.squares)) return false;
    decays = tried;
    best = linear;
    return true;
  }
};

std::vector<double> candidates(const Points& points) {
  const int n =
      static_cast<int>(kPerDecade * std::log10(fastest_decay(points) / kSlowest) + kBetter);
  std::vector<double> all = {0};
  for (int i = 0; i <= n; ++i) {
    all.push_back(kSlowest * std::pow(10, static_cast<double>(i) / kPerDecade));
  }
  return all;
}

void search_all(Search& search) {
  const std::vector<double> all = candidates(search.points);
  const std::vector<double> none = {0};
  const std::vector<double>& squares = search.points.n_pressures > 2 ? all : none;
  for (const double of_squares : squares) {
    for (const double of_lines : all) {
      for (const double of_constant : all) search.accept({of_squares, of_lines, of_constant});
    }
  }
}

/// All decays, or one, a little faster or slower.
bool improve(Search& search, double factor) {
  bool improved = false;
  for (const double by : {factor, 1 / factor}) {
    Decays all = search.decays;
    for (double& decay : all) decay *= by;
    improved = search.accept(all) || improved;
    for (std::size_t i = 0; i < search.decays.size(); ++i) {
      Decays one = search.decays;
      one.at(i) *= by;
      improved = search.accept(one) || improved;
    }
  }
  return improved;
}

/// In ever smaller steps.
void refine(Search& search) {
  for (double factor = 2; factor > kFinest;) {
    if (!improve(search, factor)) factor = std::sqrt(factor);
  }
}

DarmstadLaw law_of(const Search& search) {
  const Points& points = search.points;
  const Eigen::Vector4d& factors = search.best.factors;
  const auto rate = [&](std::size_t i) {
    return search.decays.at(i) == 0 ? 0 : -search.decays.at(i) / points.speed_scale;
  };
  return {.constant = factors[0],
          .c1 = factors[1] / (points.pressure_scale * points.pressure_scale),
          .c2 = rate(0),
          .c3 = factors[2] / points.pressure_scale,
          .c4 = rate(1),
          .c5 = factors[3],
          .c6 = rate(2)};
}

}  // namespace

double DarmstadLaw::friction(double mean_pressure, double sliding_speed) const {
  return constant + c1 * std::exp(c2 * sliding_speed) * mean_pressure * mean_pressure +
         c3 * std::exp(c4 * sliding_speed) * mean_pressure + c5 * std::exp(c6 * sliding_speed);
}

DarmstadFit fit_darmstad(const DensityLayer& layer) {
  require_two_pressures(layer);
  const Points points = points_of(layer);
  Search search(points);
  if (points.has_speeds) {
    search_all(search);
    refine(search);
  }
  DarmstadFit fit{layer.lubricant_density, law_of(search), 0};
  for (const PressureRow& row : layer.rows) {
    for (const FrictionEntry& entry : row.entries) {
      const double fitted = fit.law.friction(row.mean_pressure, entry.at.sliding_speed.value_or(0));
      fit.largest_error = std::max(fit.largest_error, std::abs(fitted - entry.friction));
    }
  }
  return fit;
}

std::vector<DarmstadFit> fit_darmstad(const FrictionTable& table) {
  std::vector<DarmstadFit> fits;
  for (const DensityLayer& layer : layers_of(table)) fits.push_back(fit_darmstad(layer));
  return fits;
}

}  // namespace tabor::forming
