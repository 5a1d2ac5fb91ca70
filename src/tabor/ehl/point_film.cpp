#include "tabor/ehl/point_film.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "tabor/ehl/gmres.hpp"
#include "tabor/ehl/point_multigrid.hpp"
#include "tabor/reference/hertz_ellipse.hpp"

namespace tabor::ehl {
namespace {

constexpr double kLinearAccuracy = 1e-3;  // of each Newton correction
constexpr int kMaxProducts = 80;
constexpr int kMaxHalvings = 8;
constexpr double kThinnest = 0.1;  // a step may leave this much of the thinnest film
constexpr double kAllCavity = 1 - 1e-9;
constexpr double kMayGrow = 1.5;  // the norm of the residual, in a step that is taken

}  // namespace

struct PointFilm::Linear {
  PointBalance balance;
  double load = 0;  // (load carried - load) / load
};

PointFilm::PointFilm(const PointProblem& problem)
    : lubricant(problem.lubricant),
      load(problem.load),
      speed(problem.entrainment_speed),
      tolerance(problem.tolerance),
      problem_(problem),
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
  levels_ = point_levels(grid_, problem.effective_modulus, units_.pressure / units_.film,
                         !problem.sparse_factors);
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
  const PointTransfer transfer(grid_, from);
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

PointFilm::Linear PointFilm::linearize(const PointState& state, const PointStorage& storage) const {
  Linear linear{.balance = point_balance(flow_of(state), storage, units_)};
  linear.load = (grid_.pixel_area() * state.pressure.sum() - load) / units_.load;
  return linear;
}

/// Jacobian times a step, with the whole elastic kernel. Held nodes keep what they are given.
Eigen::VectorXd PointFilm::product(const Linear& linear, const Mask& held,
                                   const Eigen::VectorXd& step) const {
  const Index n = grid_.size();
  const Eigen::Map<const Field> given(step.data(), grid_.ny, grid_.nx);
  const Field pressure = held.select(0, given);
  const Field film = levels_.front().elastic(pressure) + step[n];
  Field result = Field::Zero(grid_.ny, grid_.nx);
  linear.balance.by_pressure.add_product(pressure, result);
  linear.balance.by_film.add_product(film, result);
  Eigen::VectorXd all(n + 1);
  Eigen::Map<Field>(all.data(), grid_.ny, grid_.nx) = held.select(given, result);
  all[n] = grid_.pixel_area() * units_.pressure / units_.load * pressure.sum();
  return all;
}

/// The inverse of the whole system, with the separation and the load, from that of the balances.
class PointFilm::Bordered {
 public:
  Bordered(const PointMultigrid& inverse, const PointBalance& balance, const Mask& held,
           double load_weight)
      : inverse_(inverse), held_(held), load_weight_(load_weight) {
    Field by_separation = Field::Zero(held.rows(), held.cols());
    balance.by_film.add_product(Field::Ones(held.rows(), held.cols()), by_separation);
    answer_ = inverse(held.select(0, by_separation));
    border_ = -load_weight * answer_.sum();
  }

  Eigen::VectorXd operator()(const Eigen::VectorXd& right) const {
    const Index n = held_.size();
    Eigen::VectorXd result(n + 1);
    const Field pressure =
        inverse_(Eigen::Map<const Field>(right.data(), held_.rows(), held_.cols()));
    result[n] = (right[n] - load_weight_ * held_.select(0, pressure).sum()) / border_;
    Eigen::Map<Field>(result.data(), held_.rows(), held_.cols()) = pressure - result[n] * answer_;
    return result;
  }

 private:
  const PointMultigrid& inverse_;
  const Mask& held_;
  double load_weight_;
  Field answer_;  // of the pressures to a separation of one unit
  double border_ = 0;
};

/// Empty if the linear equations cannot be solved.
Eigen::VectorXd PointFilm::newton_step(const Linear& linear, const PointState& state,
                                       const PointStorage& storage, Outcome& outcome) const {
  const Mask held = this->held(state);
  const PointMultigrid inverse(levels_, linear.balance, held, flow_of(state), storage, units_);
  if (!inverse.ok()) return {};
  const double load_weight = grid_.pixel_area() * units_.pressure / units_.load;
  const Bordered precondition(inverse, linear.balance, held, load_weight);
  const auto multiply = [&](const Eigen::VectorXd& step) { return product(linear, held, step); };
  Eigen::VectorXd right(grid_.size() + 1);
  Eigen::Map<Field>(right.data(), grid_.ny, grid_.nx) = held.select(0, -linear.balance.residual);
  right[grid_.size()] = -linear.load;
  const int before = outcome.n_products;
  const auto step =
      gmres(multiply, precondition, right, kLinearAccuracy, kMaxProducts, outcome.n_products);
  outcome.n_linear_iterations += outcome.n_products - before;
  return step.value_or(Eigen::VectorXd());
}

/// Norm of what is not yet balanced: of the film, and of cavity that gains liquid.
double PointFilm::merit(const Linear& linear, const PointState& state) const {
  const Mask held = this->held(state);
  const Field& residual = linear.balance.residual;
  const Field open = held.select(state.cavity.select(residual.min(0), 0), residual);
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
                        Linear& linear, Outcome& outcome) const {
  if (step.size() == 0 || !step.allFinite()) return false;
  const PointState old = state;
  const double before = merit(linear, old);
  double share = 1;
  for (int i = 0; i <= kMaxHalvings; ++i, share /= 2) {
    ++outcome.n_products;
    if (!step_to(old, step, share, state)) continue;
    linear = linearize(state, storage);
    if (merit(linear, state) <= kMayGrow * before) return true;
  }
  state = old;
  return false;
}

/// Nodes of the cavity that gain liquid leave it; true if there are any.
bool PointFilm::refill(const Linear& linear, PointState& state) const {
  const double surplus = 0.1 * tolerance * film_scale_ / units_.film;
  const Mask held = this->held(state);
  bool changed = false;
  for (Index k = 0; k < held.size(); ++k) {
    if (!state.cavity.data()[k] || !(linear.balance.residual.data()[k] < -surplus)) continue;
    state.cavity.data()[k] = false;
    changed = true;
  }
  return changed;
}

void PointFilm::measure(const Linear& linear, const PointState& state, Outcome& outcome) const {
  const Field open = held(state).select(0, linear.balance.residual);
  outcome.mass_error = open.abs().maxCoeff() * units_.film / film_scale_;
  outcome.load_error = std::abs(linear.load);
}

PointFilm::Outcome PointFilm::solve(PointState& state, const PointStorage& storage,
                                    const Observer& observer) {
  Outcome outcome;
  state.pressure = held(state).select(0, state.pressure);
  state.film = film_of(state);
  if (!(state.film.minCoeff() > 0)) return outcome;
  Linear linear = linearize(state, storage);
  while (outcome.iterations < problem_.max_iterations && !outcome.converged) {
    ++outcome.iterations;
    const Mask cavity = state.cavity;
    const Eigen::VectorXd step = newton_step(linear, state, storage, outcome);
    if (!correct(step, storage, state, linear, outcome)) break;
    const bool grows = (state.cavity != cavity).any();
    const bool shrinks = refill(linear, state);
    measure(linear, state, outcome);
    outcome.converged =
        !grows && !shrinks && outcome.mass_error <= tolerance && outcome.load_error <= tolerance;
    const Convergence now = {.iterations = outcome.iterations,
                             .operator_applications = outcome.n_products,
                             .certificate = std::max(outcome.mass_error, outcome.load_error),
                             .tolerance = tolerance,
                             .converged = outcome.converged};
    if (observer && !observer({.stage = "point contact", .convergence = &now})) break;
  }
  return outcome;
}

}  // namespace tabor::ehl
