#include <algorithm>
#include <cmath>

#include "tabor/ehl/line/equations.hpp"

// What solids that touch add to the film: P >= 0, h >= h_b, P (h - h_b) = 0. All of it is solved
// with the film, by an interior point method: P (h - h_b) = mu at every node, with a mu that falls
// when Newton's method has come near, and steps that leave P and h - h_b above zero. A set of
// touching nodes with their film held at h_b is no way: the liquid before a node that has just been
// held cannot pass, and the next step knows nothing of its lifting the node.
namespace tabor::ehl {
namespace {

constexpr double kFirstProduct = 3;  // mu in units of pressure and film, to begin with
constexpr double kLastProduct = 1e-10;
constexpr double kFirstFall = 0.1;  // of mu from one solution to the next
constexpr double kLeastFall = 0.93;
constexpr int kMaxIterations = 25;  // for one mu
constexpr double kOnTheWay = 1e-3;  // accuracy of the balances at a mu that is not the last
constexpr double kThinnest = 0.1;   // a step may leave this much of the thinnest film
constexpr double kNearProduct = 0.1;
constexpr double kShareOfTheWay = 0.9;  // to where P or h - h_b would be zero

}  // namespace

/// Asperities that carry everything, with a mu that keeps them far above h_b.
LineState LineFilm::asperity_start(const LineConditions& conditions) const {
  LineState state =
      hertz_start(problem_.asperities.boundary_film + kFirstProduct * film_scale_, conditions);
  state.film = film_of(state, conditions.shape);
  state.touch_product = kFirstProduct;
  state.asperity_pressure = state.pressure.max(kFirstProduct * units_.pressure * film_scale_ /
                                               (state.film - problem_.asperities.boundary_film));
  state.pressure.setZero();
  state.film = film_of(state, conditions.shape);
  const double lacking = problem_.asperities.boundary_film + film_scale_ - state.film.minCoeff();
  state.separation += std::max(0.0, lacking);
  return state;
}

LineFilm::Outcome LineFilm::solve_touching(LineState& state, const LineConditions& conditions,
                                           const Observer& observer) const {
  state = asperity_start(conditions);
  Outcome outcome = solve(state, conditions, {}, 2 * kMaxIterations, observer);
  double fall = kFirstFall;
  while (outcome.convergence.converged() && state.touch_product > kLastProduct) {
    LineState next = state;
    next.touch_product = std::max(kLastProduct, fall * state.touch_product);
    Outcome now = solve(next, conditions, {}, kMaxIterations, observer);
    if (now.convergence.converged()) {
      state = next;
      fall *= std::sqrt(fall);
    } else {
      fall = std::sqrt(std::sqrt(fall));
    }
    fall = std::max(fall, kFirstFall);
    outcome = outcome + now;
    // Tried again with a mu nearer to the one that was solved.
    if (now.convergence.failed() && fall < kLeastFall) {
      outcome.convergence.status = Status::converged;
    }
  }
  return outcome;
}

/// True if the equations hold: less well on the way to the last mu.
bool LineFilm::Equations::is_balanced() const {
  const double error = std::max(outcome_.mass_error, outcome_.load_error);
  if (!touches()) return error <= kLineTolerance;
  const double off = (overlap_products() / state_.touch_product - 1).abs().maxCoeff();
  const double accuracy = state_.touch_product > kLastProduct ? kOnTheWay : kLineTolerance;
  return error <= accuracy && off <= kNearProduct;
}

/// P (h - h_b) over the units of pressure and film.
Eigen::ArrayXd LineFilm::Equations::overlap_products() const {
  return state_.asperity_pressure / film_.units_.pressure *
         (state_.film - film_.problem_.asperities.boundary_film) / film_.film_scale_;
}

/// The equations of P, each divided by the sum of its factors.
void LineFilm::Equations::add_touch(LineLinear& linear) const {
  const Index n = film_.n_;
  const LineUnits& units = film_.units_;
  const Eigen::ArrayXd clearance =
      (state_.film - film_.problem_.asperities.boundary_film) / units.film;
  const Eigen::ArrayXd pressure = state_.asperity_pressure / units.pressure;
  const Eigen::ArrayXd scale = clearance + pressure;
  const double aim = state_.touch_product * film_.film_scale_ / units.film;
  linear.system.touch = {pressure / scale, clearance / scale};
  linear.residual.conservativeResize(linear.system.size());
  linear.residual.segment(n, n) = (clearance * pressure - aim) / scale;
  const double total = (state_.pressure + state_.asperity_pressure).sum();
  linear.load_residual() =
      (film_.elastic_.load_weight() * total - film_.problem_.load) / units.load;
}

/// How much of a step can be taken before P or h - h_b is zero somewhere, and a little less; 1 at
/// most.
double LineFilm::Equations::share_before_touch(const Eigen::VectorXd& step) const {
  const Index n = film_.n_;
  const LineUnits& units = film_.units_;
  LineState whole = state_;
  whole.pressure += units.pressure * step.head(n).array();
  whole.asperity_pressure += units.pressure * step.segment(n, n).array();
  whole.separation += units.film * step[step.size() - 1];
  whole.film = film_.film_of(whole, conditions_.shape);
  const Eigen::ArrayXd clearance = state_.film - film_.problem_.asperities.boundary_film;
  const double film = ((state_.film - whole.film) / clearance).maxCoeff();
  const double pressure =
      ((state_.asperity_pressure - whole.asperity_pressure) / state_.asperity_pressure).maxCoeff();
  return std::min(1.0, kShareOfTheWay / std::max({film, pressure, kShareOfTheWay}));
}

/// Without asperities a step must leave some of the film.
bool LineFilm::Equations::is_open(const LineState& old) const {
  if (!touches()) return state_.film.minCoeff() > kThinnest * old.film.minCoeff();
  return state_.film.minCoeff() > film_.problem_.asperities.boundary_film &&
         state_.asperity_pressure.minCoeff() > 0;
}

Eigen::ArrayXd LineFilm::touching_pressure(const LineState& state) const {
  if (state.asperity_pressure.size() == 0) return Eigen::ArrayXd::Zero(n_);
  const Eigen::ArrayXd clearance = (state.film - problem_.asperities.boundary_film) / film_scale_;
  return (state.asperity_pressure / units_.pressure > clearance)
      .select(state.asperity_pressure, 0.0);
}

}  // namespace tabor::ehl
