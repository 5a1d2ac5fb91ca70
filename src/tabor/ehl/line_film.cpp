#include "tabor/ehl/line_film.hpp"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tabor/ehl/gmres.hpp"
#include "tabor/lubrication/reynolds.hpp"

namespace tabor::ehl {
namespace {

constexpr double kTolerance = 1e-8;       // of residuals, over the flow in the contact
constexpr double kLinearAccuracy = 1e-4;  // of each Newton correction
constexpr int kMaxProducts = 60;
constexpr int kMaxHalvings = 8;
constexpr double kThinnest = 0.1;  // a step may leave this much of the thinnest film

double spacing_of(const Eigen::ArrayXd& x) {
  return (x[x.size() - 1] - x[0]) / static_cast<double>(x.size() - 1);
}

}  // namespace

/// Balances and load in units of u_m times the unit of film, and their derivatives by the unknowns
/// in their units. Balances of the cavity say what its nodes lack to stay full.
struct LineFilm::Linear {
  Eigen::VectorXd residual;  // n + 1
  LineBands by_pressure, by_film;

  explicit Linear(Index n) : residual(Eigen::VectorXd::Zero(n + 1)), by_pressure(n), by_film(n) {}
  void add_face(Index left, const lubrication::FaceFlow& face, double unit, const LineUnits& units);
};

LineFilm::LineFilm(const LineProblem& problem)
    : shape(line_nodes(problem).square() / (2 * problem.radius)),
      lubricant(problem.lubricant),
      load(problem.load),
      speed(problem.entrainment_speed),
      problem_(problem),
      n_(problem.nodes),
      x_(line_nodes(problem)),
      spacing_(spacing_of(x_)),
      elastic_(n_, spacing_, problem.effective_modulus) {
  if (problem.roughness.size() > 0) shape -= problem.roughness;
  const reference::HertzLineContact hertz = hertz_of(problem);
  film_scale_ = film_groups_of(problem).moes_min_film();
  pressed_width_ = std::max(hertz.half_width, std::sqrt(2 * problem.radius * film_scale_));
  units_.pressure = 2 * problem.load / (std::numbers::pi * pressed_width_);
  units_.film = std::max(hertz.half_width * hertz.half_width / problem.radius, film_scale_);
  units_.load = problem.load;
}

LineState LineFilm::hertz_start(double min_film) const {
  // Rather too far out: a cavity grows at once but shrinks node by node.
  const double rupture = pressed_width_ + std::sqrt(2 * problem_.radius * film_scale_);
  LineState state;
  state.cavity.assign(static_cast<std::size_t>(n_), false);
  state.pressure.resize(n_);
  for (Index i = 0; i < n_; ++i) {
    const double place = x_[i] / pressed_width_;
    state.pressure[i] = units_.pressure * std::sqrt(std::max(0.0, 1 - place * place));
    state.cavity[static_cast<std::size_t>(i)] = x_[i] >= rupture;
  }
  state.separation = 0;
  state.film = film_of(state);
  state.separation = min_film - state.film.minCoeff();
  state.film += state.separation;
  return state;
}

Eigen::ArrayXd LineFilm::deflection(const Eigen::ArrayXd& pressure) const {
  Eigen::ArrayXd result(n_);
  const auto n = static_cast<std::size_t>(n_);
  elastic_.apply({pressure.data(), n}, {result.data(), n});
  return result;
}

Eigen::ArrayXd LineFilm::film_of(const LineState& state) const {
  return deflection(state.pressure) + shape + state.separation;
}

Eigen::ArrayXd LineFilm::mass_of(const LineState& state) const {
  Eigen::ArrayXd mass(n_);
  for (Index i = 0; i < n_; ++i) {
    mass[i] = lubricant.density.at(state.pressure[i]).value * state.film[i];
  }
  return mass;
}

/// The flow through the face between two nodes in the balances of both.
void LineFilm::Linear::add_face(Index left, const lubrication::FaceFlow& face, double unit,
                                const LineUnits& units) {
  LineBands* const bands[2] = {&by_pressure, &by_film};
  const double* const slopes[2] = {face.by_pressure, face.by_film};
  const double scales[2] = {units.pressure, units.film};
  for (int own = 0; own < 2; ++own) {
    const Index i = left + own;
    const double sign = own == 0 ? unit : -unit;  // the left node loses what the right one gains
    residual[i] += sign * face.flow;
    for (int k = 0; k < 2; ++k) {
      Eigen::ArrayXd& other = own == 0 ? bands[k]->upper : bands[k]->lower;
      bands[k]->diagonal[i] += sign * slopes[k][own] * scales[k];
      other[i] += sign * slopes[k][1 - own] * scales[k];
    }
  }
}

LineFilm::Linear LineFilm::linearize(const LineState& state, const LineStorage& storage) const {
  material::NodeLaws laws;
  material::evaluate(lubricant, {state.pressure.data(), static_cast<std::size_t>(n_)}, laws);
  const auto node = [&](Index i) {
    return lubrication::FilmNode{.pressure = state.pressure[i],
                                 .film = state.film[i],
                                 .liquid = {.density = laws.density[i],
                                            .density_slope = laws.density_by_pressure[i],
                                            .viscosity = laws.viscosity[i],
                                            .viscosity_slope = laws.viscosity_by_pressure[i]},
                                 .distance = spacing_ / 2};
  };
  Linear linear(n_);
  const double unit = 1 / (problem_.entrainment_speed * units_.film);
  for (Index left = 0; left + 1 < n_; ++left) {
    linear.add_face(left, lubrication::face_flow(node(left), node(left + 1), speed), unit, units_);
  }
  if (storage.time_step > 0) {
    const double rate = unit * spacing_ / storage.time_step;
    linear.residual.head(n_).array() += rate * (laws.density * state.film - storage.old_mass);
    linear.by_film.diagonal += rate * laws.density * units_.film;
    linear.by_pressure.diagonal += rate * laws.density_by_pressure * state.film * units_.pressure;
  }
  if (problem_.cavitation == LineCavitation::penalty) {
    const double strength = problem_.penalty * spacing_ / units_.film;
    linear.residual.head(n_).array() += strength * state.pressure.min(0) / units_.pressure;
    linear.by_pressure.diagonal += strength * (state.pressure < 0).cast<double>();
  }
  linear.residual[n_] = (elastic_.load_weight() * state.pressure.sum() - load) / units_.load;
  return linear;
}

namespace {

/// Rows of the nodes whose pressure is given.
void hold(const std::vector<bool>& held, LineBands& by_pressure, LineBands& by_film) {
  for (Index i = 0; i < by_pressure.diagonal.size(); ++i) {
    if (!held[static_cast<std::size_t>(i)]) continue;
    by_pressure.diagonal[i] = 1;
    for (auto* band : {&by_pressure.lower, &by_pressure.upper, &by_film.lower, &by_film.diagonal,
                       &by_film.upper}) {
      (*band)[i] = 0;
    }
  }
}

}  // namespace

/// The plain way: all of the Jacobian, for comparison.
Eigen::MatrixXd LineFilm::dense_jacobian(const LineBands& by_pressure,
                                         const LineBands& by_film) const {
  const Eigen::MatrixXd elastic = units_.pressure / units_.film * elastic_.matrix();
  Eigen::MatrixXd matrix(n_ + 1, n_ + 1);
  for (Index i = 0; i < n_; ++i) {
    auto row = matrix.row(i);
    row.head(n_) = by_film.diagonal[i] * elastic.row(i);
    row[n_] = by_film.diagonal[i] + by_film.lower[i] + by_film.upper[i];
    row[i] += by_pressure.diagonal[i];
    if (i > 0) row.head(n_) += by_film.lower[i] * elastic.row(i - 1);
    if (i > 0) row[i - 1] += by_pressure.lower[i];
    if (i + 1 < n_) row.head(n_) += by_film.upper[i] * elastic.row(i + 1);
    if (i + 1 < n_) row[i + 1] += by_pressure.upper[i];
  }
  matrix.row(n_).setConstant(elastic_.load_weight() * units_.pressure / units_.load);
  matrix(n_, n_) = 0;
  return matrix;
}

/// Jacobian times a step, with the whole elastic kernel.
Eigen::VectorXd LineFilm::product(const LineBands& by_pressure, const LineBands& by_film,
                                  const Eigen::VectorXd& step) const {
  const Eigen::ArrayXd pressure = step.head(n_);
  const Eigen::ArrayXd film = units_.pressure / units_.film * deflection(pressure) + step[n_];
  Eigen::VectorXd result(n_ + 1);
  result << (by_pressure.product(pressure) + by_film.product(film)).matrix(),
      elastic_.load_weight() * units_.pressure / units_.load * pressure.sum();
  return result;
}

/// Empty if the linear equations cannot be solved.
Eigen::VectorXd LineFilm::newton_step(const Linear& linear, const LineState& state,
                                      int& n_products) const {
  LineBands by_pressure = linear.by_pressure;
  LineBands by_film = linear.by_film;
  hold(state.cavity, by_pressure, by_film);
  Eigen::VectorXd right = -linear.residual;
  for (Index i = 0; i < n_; ++i) {
    if (state.cavity[static_cast<std::size_t>(i)]) right[i] = 0;
  }
  if (problem_.dense_jacobian) {
    return dense_jacobian(by_pressure, by_film).partialPivLu().solve(right);
  }
  const LineInverse inverse(elastic_, units_, by_pressure, by_film);
  if (!inverse.ok()) return {};
  const auto multiply = [&](const Eigen::VectorXd& step) {
    return product(by_pressure, by_film, step);
  };
  return gmres(multiply, inverse, right, kLinearAccuracy, kMaxProducts, n_products)
      .value_or(Eigen::VectorXd());
}

/// Applies a Newton correction, halved until the gap stays open. False if that does not help.
bool LineFilm::correct(const Eigen::VectorXd& step, LineState& state) const {
  if (step.size() == 0 || !step.allFinite()) return false;
  const LineState old = state;
  const double floor = kThinnest * old.film.minCoeff();
  const material::PressureRange range = material::computable_range(lubricant);
  const bool clips = problem_.cavitation == LineCavitation::reynolds;
  double share = 1;
  for (int i = 0; i <= kMaxHalvings; ++i, share /= 2) {
    state.pressure = old.pressure + share * units_.pressure * step.head(n_).array();
    state.separation = old.separation + share * units_.film * step[n_];
    // What falls below zero joins the cavity at once.
    for (Index k = 0; clips && k < n_; ++k) {
      if (state.pressure[k] >= 0) continue;
      state.cavity[static_cast<std::size_t>(k)] = true;
      state.pressure[k] = 0;
    }
    state.film = film_of(state);
    if (state.film.minCoeff() > floor && range.contains(state.pressure.maxCoeff()) &&
        range.contains(state.pressure.minCoeff())) {
      return true;
    }
    state.cavity = old.cavity;
  }
  return false;
}

/// Nodes of the cavity that gain liquid leave it, with `reach` nodes of it behind them; true if
/// there are any. The ends stay.
bool LineFilm::refill(const Linear& linear, LineState& state, Index reach) const {
  const double surplus = kTolerance * film_scale_ / units_.film;
  Index last = -1;
  bool changed = false;
  for (Index i = 1; i + 1 < n_; ++i) {
    if (!state.cavity[static_cast<std::size_t>(i)]) continue;
    if (linear.residual[i] < -surplus) last = i + reach - 1;
    if (i > last) continue;
    state.cavity[static_cast<std::size_t>(i)] = false;
    changed = true;
  }
  return changed;
}

double LineFilm::mass_error(const Linear& linear, const LineState& state) const {
  double imbalance = 0;
  for (Index i = 0; i < n_; ++i) {
    if (state.cavity[static_cast<std::size_t>(i)]) continue;
    imbalance = std::max(imbalance, std::abs(linear.residual[i]));
  }
  return imbalance * units_.film / film_scale_;
}

LineFilm::Outcome LineFilm::solve(LineState& state, const LineStorage& storage, int max_iterations,
                                  const Observer& observer) const {
  Outcome outcome;
  Index reach = 1;
  state.cavity.front() = state.cavity.back() = true;
  state.pressure[0] = state.pressure[n_ - 1] = 0;
  state.film = film_of(state);
  Linear linear = linearize(state, storage);
  while (outcome.iterations < max_iterations && !outcome.converged) {
    ++outcome.iterations;
    const std::vector<bool> cavity = state.cavity;
    if (!correct(newton_step(linear, state, outcome.n_products), state)) return outcome;
    linear = linearize(state, storage);
    const bool grows = state.cavity != cavity;
    const bool shrinks = refill(linear, state, reach);
    // A front that retreats node by node is made to go two at once; more would overshoot.
    reach = shrinks && !grows ? 2 : 1;
    outcome.mass_error = mass_error(linear, state);
    outcome.load_error = std::abs(linear.residual[n_]);
    outcome.converged =
        !grows && !shrinks && outcome.mass_error <= kTolerance && outcome.load_error <= kTolerance;
    const Convergence now = {.iterations = outcome.iterations,
                             .operator_applications = outcome.n_products,
                             .certificate = outcome.mass_error,
                             .tolerance = kTolerance,
                             .converged = outcome.converged};
    if (observer && !observer({.stage = "line contact", .convergence = &now})) return outcome;
  }
  return outcome;
}

}  // namespace tabor::ehl
