#include "tabor/ehl/point/film.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>

#include "tabor/ehl/point/bordered.hpp"
#include "tabor/ehl/point/multigrid.hpp"
#include "tabor/reference/hertz_ellipse.hpp"

namespace tabor::ehl {
namespace {

constexpr int kMaxHalvings = 8;
constexpr double kThinnest = 0.1;  // a step may leave this much of the thinnest film
constexpr double kAllCavity = 1 - 1e-9;
constexpr double kMayGrow = 1.5;  // the norm of the residual, in a step that is taken

}  // namespace

PointFilm::PointFilm(const PointProblem& problem, bool coarsens)
    : lubricant(problem.lubricant),
      load(problem.load),
      speed(problem.entrainment_speed),
      tolerance(problem.tolerance),
      problem_(problem),
      coarsens_(coarsens),
      grid_(point_grid(problem)),
      x_(point_x(problem)),
      y_(point_y(problem)) {
  shape = (y_.square() / (2 * problem.radius_y)).replicate(1, x_.size()) +
          (x_.square() / (2 * problem.radius_x)).transpose().replicate(y_.size(), 1);
  if (problem.roughness.size() > 0) shape -= problem.roughness;
  problem_.roughness.resize(0, 0);
  const reference::HertzEllipse hertz = hertz_of(problem);
  film_scale_ = film_groups_of(problem).nijenbanning_central();
  pressed_width_x_ = std::max(hertz.half_axis_x, std::sqrt(2 * problem.radius_x * film_scale_));
  pressed_width_y_ = std::max(hertz.half_axis_y, std::sqrt(2 * problem.radius_y * film_scale_));
  units_.pressure = 1.5 * load / (std::numbers::pi * pressed_width_x_ * pressed_width_y_);
  units_.film = std::max(hertz.half_axis_x * hertz.half_axis_x / problem.radius_x, film_scale_);
  units_.load = load;
  levels_ = point_levels(grid_, problem.effective_modulus, units_.pressure / units_.film, coarsens);
}

PointState PointFilm::hertz_start(double min_film) const {
  // The cavity begins rather too far out: it grows at once but shrinks node by node.
  const double rupture = pressed_width_x_ + std::sqrt(2 * problem_.radius_x * film_scale_);
  PointState state;
  state.pressure.resize(y_.size(), x_.size());
  state.cavity.resize(y_.size(), x_.size());
  for (Index j = 0; j < y_.size(); ++j) {
    for (Index i = 0; i < x_.size(); ++i) {
      const double inside =
          1 - std::pow(x_[i] / pressed_width_x_, 2) - std::pow(y_[j] / pressed_width_y_, 2);
      state.pressure(j, i) = units_.pressure * std::sqrt(std::max(0.0, inside));
      state.cavity(j, i) = x_[i] >= rupture;
    }
  }
  state.film = film_of(state);
  state.separation = min_film - state.film.minCoeff();
  state.film += state.separation;
  return state;
}

PointState PointFilm::resampled(const PointState& state, const Grid& from) const {
  const numerics::NodeTransfer transfer(grid_, from);
  PointState result{.pressure = transfer.to_fine(state.pressure),
                    .separation = state.separation,
                    .film = {},
                    .cavity = transfer.to_fine(state.cavity.cast<double>()) > kAllCavity};
  result.film = film_of(result);
  return result;
}

Field PointFilm::deflection(const Field& pressure) const {
  return units_.film * levels_.front().elastic(pressure / units_.pressure);
}

Field PointFilm::film_of(const PointState& state) const {
  return deflection(state.pressure) + shape + state.separation;
}

Field PointFilm::mass_of(const PointState& state) const {
  return state.film *
         state.pressure.unaryExpr([&](double p) { return lubricant.density.at(p).value; });
}

/// Nodes whose pressure is given.
Mask PointFilm::held(const PointState& state) const {
  Mask held = state.cavity;
  held.row(0) = held.row(held.rows() - 1) = true;
  held.col(0) = held.col(held.cols() - 1) = true;
  return held;
}

PointFlow PointFilm::flow_of(const PointState& state) const {
  return {.grid = grid_,
          .lubricant = lubricant,
          .speed = speed,
          .sliding_speed = problem_.sliding_speed,
          .pressure = state.pressure,
          .film = state.film};
}

PointLinear PointFilm::linearize(const PointState& state, const PointStorage& storage) const {
  return {.rows = point_balance(flow_of(state), storage, units_),
          .held = held(state),
          .deep = Mask::Constant(grid_.ny, grid_.nx, false),
          .load = (grid_.pixel_area() * state.pressure.sum() - load) / units_.load};
}

/// Empty if the linear equations cannot be solved.
Eigen::VectorXd PointFilm::newton_step(const PointLinear& linear, const PointState& state,
                                       const PointStorage& storage, Outcome& outcome) const {
  const PointMultigrid inverse(levels_, linear.rows, linear.held, flow_of(state), storage, units_);
  if (!inverse.ok()) return {};
  int& n_products = outcome.convergence.operator_applications;
  const int before = n_products;
  const auto step = solve_bordered(linear, levels_.front(), units_, std::cref(inverse), n_products);
  outcome.n_linear_iterations += n_products - before;
  return step.value_or(Eigen::VectorXd());
}

/// Norm of what is not yet balanced: of the film, and of cavity that gains liquid.
double PointFilm::merit(const PointLinear& linear, const PointState& state) const {
  const Field& residual = linear.rows.residual;
  const Field open = linear.held.select(state.cavity.select(residual.min(0), 0), residual);
  const double relative = units_.film / film_scale_;
  return std::sqrt(open.square().sum() * relative * relative / static_cast<double>(x_.size()) +
                   linear.load * linear.load);
}

/// The state a share of the step away; false where the gap would close or a law would end.
bool PointFilm::step_to(const PointState& old, const Eigen::VectorXd& step, double share,
                        PointState& state) const {
  const Index n = grid_.size();
  const Eigen::Map<const Field> change(step.data(), grid_.ny, grid_.nx);
  state.pressure = old.pressure + share * units_.pressure * change;
  state.separation = old.separation + share * units_.film * step[n];
  // What falls below zero joins the cavity at once.
  state.cavity = old.cavity || state.pressure < 0;
  state.pressure = state.pressure.max(0);
  if (!material::computable_range(lubricant).contains(state.pressure.maxCoeff())) return false;
  state.film = film_of(state);
  return state.film.minCoeff() > kThinnest * old.film.minCoeff();
}

/// Applies a Newton correction, halved until the gap stays open and the residual does not grow
/// much. False if that does not help.
bool PointFilm::correct(const Eigen::VectorXd& step, const PointStorage& storage, PointState& state,
                        PointLinear& linear, Outcome& outcome) const {
  if (step.size() == 0 || !step.allFinite()) return false;
  const PointState old = state;
  const double before = merit(linear, old);
  double share = 1;
  for (int i = 0; i <= kMaxHalvings; ++i, share /= 2) {
    ++outcome.convergence.operator_applications;
    if (!step_to(old, step, share, state)) continue;
    linear = linearize(state, storage);
    if (merit(linear, state) <= kMayGrow * before) return true;
  }
  state = old;
  return false;
}

/// Nodes of the cavity that gain liquid leave it; true if there are any.
bool PointFilm::refill(PointLinear& linear, PointState& state) const {
  const double surplus = 0.1 * tolerance * film_scale_ / units_.film;
  bool changed = false;
  for (Index k = 0; k < state.cavity.size(); ++k) {
    if (!state.cavity.data()[k] || !(linear.rows.residual.data()[k] < -surplus)) continue;
    state.cavity.data()[k] = linear.held.data()[k] = false;
    changed = true;
  }
  return changed;
}

void PointFilm::measure(const PointLinear& linear, Outcome& outcome) const {
  const Field open = linear.held.select(0, linear.rows.residual);
  outcome.mass_error = open.abs().maxCoeff() * units_.film / film_scale_;
  outcome.load_error = std::abs(linear.load);
  outcome.convergence.certificate = std::max(outcome.mass_error, outcome.load_error);
}

PointFilm::Outcome PointFilm::solve(PointState& state, const PointStorage& storage,
                                    const Observer& observer) {
  Outcome outcome;
  Convergence& convergence = outcome.convergence;
  convergence.tolerance = tolerance;
  state.pressure = held(state).select(0, state.pressure);
  state.film = film_of(state);
  if (!(state.film.minCoeff() > 0)) {
    convergence.status = Status::stalled;
    return outcome;
  }
  if (asks_to_stop(observer, {.stage = "point contact"})) {
    convergence.status = Status::stopped;
    return outcome;
  }
  PointLinear linear = linearize(state, storage);
  while (convergence.status == Status::iteration_limit &&
         convergence.iterations < problem_.max_iterations) {
    ++convergence.iterations;
    const Mask cavity = state.cavity;
    const Eigen::VectorXd step = newton_step(linear, state, storage, outcome);
    if (!correct(step, storage, state, linear, outcome)) {
      convergence.status = Status::stalled;
      break;
    }
    const bool grows = (state.cavity != cavity).any();
    const bool shrinks = refill(linear, state);
    measure(linear, outcome);
    if (!grows && !shrinks && outcome.mass_error <= tolerance && outcome.load_error <= tolerance) {
      convergence.status = Status::converged;
    }
    if (asks_to_stop(observer, {.stage = "point contact", .convergence = &convergence})) {
      convergence.status = Status::stopped;
    }
  }
  return outcome;
}

}  // namespace tabor::ehl
