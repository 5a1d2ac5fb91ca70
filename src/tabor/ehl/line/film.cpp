#include "tabor/ehl/line/film.hpp"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tabor/ehl/line/inverse.hpp"
#include "tabor/numerics/gmres.hpp"
#include "tabor/reynolds/reynolds.hpp"

namespace tabor::ehl {
namespace {

constexpr double kLinearAccuracy = 1e-4;  // of each Newton correction
constexpr int kMaxProducts = 60;
constexpr int kMaxHalvings = 8;
constexpr double kThinnest = 0.1;  // a step may leave this much of the thinnest film

double spacing_of(const Eigen::ArrayXd& x) {
  return (x[x.size() - 1] - x[0]) / static_cast<double>(x.size() - 1);
}

/// The flow through the face between two nodes in the balances of both.
void add_face(LineLinear& linear, Index left, const reynolds::FaceFlow& face, double unit) {
  LineSystem& system = linear.system;
  LineBands* const bands[2] = {&system.by_pressure, &system.by_film};
  const double* const slopes[2] = {face.by_pressure, face.by_film};
  const double scales[2] = {system.units.pressure, system.units.film};
  for (int own = 0; own < 2; ++own) {
    const Index i = left + own;
    const double sign = own == 0 ? unit : -unit;  // the left node loses what the right one gains
    linear.residual[i] += sign * face.flow;
    for (int k = 0; k < 2; ++k) {
      Eigen::ArrayXd& other = own == 0 ? bands[k]->upper : bands[k]->lower;
      bands[k]->diagonal[i] += sign * slopes[k][own] * scales[k];
      other[i] += sign * slopes[k][1 - own] * scales[k];
    }
  }
}

}  // namespace

LineFilm::LineFilm(const LineProblem& problem, bool full_matrix)
    : shape(line_nodes(problem).square() / (2 * problem.radius)),
      lubricant(problem.lubricant),
      load(problem.load),
      speed(problem.entrainment_speed),
      problem_(problem),
      full_matrix_(full_matrix),
      n_(problem.nodes),
      x_(line_nodes(problem)),
      spacing_(spacing_of(x_)),
      elastic_(n_, spacing_, problem.effective_modulus) {
  if (problem.roughness.size() > 0) shape -= problem.roughness;
  const reference::HertzLineContact hertz = hertz_of(problem);
  film_scale_ = std::max(film_groups_of(problem).moes_min_film(), problem.asperities.boundary_film);
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
  state.separation = min_film - (deflection(state.pressure) + shape).minCoeff();
  return state;
}

Eigen::ArrayXd LineFilm::deflection(const Eigen::ArrayXd& pressure) const {
  Eigen::ArrayXd result(n_);
  const auto n = static_cast<std::size_t>(n_);
  elastic_.apply({pressure.data(), n}, {result.data(), n});
  return result;
}

void LineFilm::update_film(LineState& state) const {
  const bool touches = state.asperity_pressure.size() > 0;
  const Eigen::ArrayXd total =
      touches ? Eigen::ArrayXd(state.pressure + state.asperity_pressure) : state.pressure;
  state.film = deflection(total) + shape + state.separation;
}

Eigen::ArrayXd LineFilm::mass_of(const LineState& state) const {
  Eigen::ArrayXd mass(n_);
  for (Index i = 0; i < n_; ++i) {
    mass[i] = lubricant.density.at(state.pressure[i]).value * state.film[i];
  }
  return mass;
}

LineLinear LineFilm::linearize(const LineState& state, const LineStorage& storage) const {
  material::NodeLaws laws;
  material::evaluate(lubricant, {state.pressure.data(), static_cast<std::size_t>(n_)}, laws);
  const auto node = [&](Index i) {
    return reynolds::FilmNode{.pressure = state.pressure[i],
                              .film = state.film[i],
                              .liquid = reynolds::liquid_at(laws, i),
                              .distance = spacing_ / 2};
  };
  LineLinear linear{{&elastic_, units_, LineBands(n_), LineBands(n_)},
                    Eigen::VectorXd::Zero(n_ + 1)};
  LineBands& by_pressure = linear.system.by_pressure;
  LineBands& by_film = linear.system.by_film;
  const double unit = 1 / (problem_.entrainment_speed * units_.film);
  for (Index left = 0; left + 1 < n_; ++left) {
    add_face(linear, left, reynolds::face_flow(node(left), node(left + 1), speed), unit);
  }
  if (storage.time_step > 0) {
    const double rate = unit * spacing_ / storage.time_step;
    linear.residual.head(n_).array() += rate * (laws.density * state.film - storage.old_mass);
    by_film.diagonal += rate * laws.density * units_.film;
    by_pressure.diagonal += rate * laws.density_by_pressure * state.film * units_.pressure;
  }
  if (problem_.cavitation == LineCavitation::penalty) {
    const double strength = problem_.penalty * spacing_ / units_.film;
    linear.residual.head(n_).array() += strength * state.pressure.min(0) / units_.pressure;
    by_pressure.diagonal += strength * (state.pressure < 0).cast<double>();
  }
  linear.load_residual() = (elastic_.load_weight() * state.pressure.sum() - load) / units_.load;
  if (state.asperity_pressure.size() > 0) add_touch(state, linear);
  return linear;
}

Eigen::VectorXd LineFilm::newton_step(LineLinear linear, const LineState& state,
                                      int& n_products) const {
  linear.system.hold(state.cavity);
  Eigen::VectorXd right = -linear.residual;
  for (Index i = 0; i < n_; ++i) {
    if (state.cavity[static_cast<std::size_t>(i)]) right[i] = 0;
  }
  if (full_matrix_) return linear.system.dense().partialPivLu().solve(right);
  const LineInverse inverse(linear.system);
  if (!inverse.ok()) return {};
  const auto multiply = [&](const Eigen::VectorXd& step) { return linear.system.product(step); };
  return numerics::gmres(multiply, inverse, right, kLinearAccuracy, kMaxProducts, n_products)
      .value_or(Eigen::VectorXd());
}

/// The share of a Newton correction, from an old state. What falls below zero joins the cavity at
/// once.
void LineFilm::move(const LineState& old, const Eigen::VectorXd& step, double share,
                    LineState& state) const {
  state.pressure = old.pressure + share * units_.pressure * step.head(n_).array();
  state.separation = old.separation + share * units_.film * step[step.size() - 1];
  if (step.size() > n_ + 1) {
    state.asperity_pressure =
        old.asperity_pressure + share * units_.pressure * step.segment(n_, n_).array();
  }
  for (Index k = 0; problem_.cavitation == LineCavitation::reynolds && k < n_; ++k) {
    if (state.pressure[k] >= 0) continue;
    state.cavity[static_cast<std::size_t>(k)] = true;
    state.pressure[k] = 0;
  }
  update_film(state);
}

/// Applies a Newton correction, halved until the gap stays open. False if that does not help.
bool LineFilm::correct(const Eigen::VectorXd& step, LineState& state) const {
  if (step.size() == 0 || !step.allFinite()) return false;
  const LineState old = state;
  const double floor = kThinnest * old.film.minCoeff();
  const material::PressureRange range = material::computable_range(lubricant);
  double share = step.size() > n_ + 1 ? share_before_touch(old, step) : 1;
  for (int i = 0; i <= kMaxHalvings; ++i, share /= 2) {
    move(old, step, share, state);
    if (is_open(state, floor) && range.contains(state.pressure.maxCoeff()) &&
        range.contains(state.pressure.minCoeff())) {
      return true;
    }
    state.cavity = old.cavity;
  }
  return false;
}

/// Nodes of the cavity that gain liquid leave it, with `reach` nodes of it behind them; true if
/// there are any. The ends stay.
bool LineFilm::refill(const LineLinear& linear, LineState& state, Index reach) const {
  const double surplus = kLineTolerance * film_scale_ / units_.film;
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

double LineFilm::mass_error(const LineLinear& linear, const LineState& state) const {
  double imbalance = 0;
  for (Index i = 0; i < n_; ++i) {
    if (state.cavity[static_cast<std::size_t>(i)]) continue;
    imbalance = std::max(imbalance, std::abs(linear.residual[i]));
  }
  return imbalance * units_.film / film_scale_;
}

LineFilm::Outcome operator+(const LineFilm::Outcome& before, LineFilm::Outcome now) {
  now.convergence = after(before.convergence, now.convergence);
  return now;
}

LineFilm::Outcome LineFilm::solve(LineState& state, const LineStorage& storage, int max_iterations,
                                  const Observer& observer) const {
  Outcome outcome;
  Convergence& convergence = outcome.convergence;
  convergence.tolerance = kLineTolerance;
  Index reach = 1;
  state.cavity.front() = state.cavity.back() = true;
  state.pressure[0] = state.pressure[n_ - 1] = 0;
  update_film(state);
  LineLinear linear = linearize(state, storage);
  if (asks_to_stop(observer, {.stage = "line contact"})) convergence.status = Status::stopped;
  while (convergence.status == Status::iteration_limit && convergence.iterations < max_iterations) {
    ++convergence.iterations;
    const std::vector<bool> cavity = state.cavity;
    if (!correct(newton_step(linear, state, convergence.operator_applications), state)) {
      convergence.status = Status::stalled;
      break;
    }
    linear = linearize(state, storage);
    const bool grows = state.cavity != cavity;
    const bool shrinks = refill(linear, state, reach);
    // A front that retreats node by node is made to go two at once; more would overshoot.
    reach = shrinks && !grows ? 2 : 1;
    outcome.mass_error = mass_error(linear, state);
    outcome.load_error = std::abs(linear.load_residual());
    if (state.asperity_pressure.size() > 0) {
      outcome.contact_error = overlap_products(state).maxCoeff();
    }
    convergence.certificate = outcome.mass_error;
    if (!grows && !shrinks && is_balanced(state, outcome)) convergence.status = Status::converged;
    if (asks_to_stop(observer, {.stage = "line contact", .convergence = &convergence})) {
      convergence.status = Status::stopped;
    }
  }
  return outcome;
}

}  // namespace tabor::ehl
