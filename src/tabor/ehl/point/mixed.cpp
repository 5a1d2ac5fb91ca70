#include "tabor/ehl/point/mixed.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "tabor/ehl/point/film.hpp"
#include "tabor/ehl/point/start.hpp"
#include "tabor/numerics/field_statistics.hpp"

namespace tabor::ehl {
namespace {

using Outcome = PointFilm::Outcome;

constexpr double kClearance = 1;        // film of a first speed, in rms heights
constexpr double kBoundaryFilms = 5;    // ... or in boundary films
constexpr double kFastest = 1e6;        // speed of a start over the one asked for, at most
constexpr double kFilmExponent = 0.67;  // film ~ speed^0.67, Hamrock & Dowson 1977
constexpr double kLogStep = 1.2;        // of the speed, at first: a factor of 3.3
constexpr double kShortest = 1.0 / 32;  // step over the first
/// Boundary films that count as touching in results: a boundary film that left a pressure of GPa is
/// thicker by the ratio of densities, at most 1.35 by Dowson & Higginson.
constexpr double kTouchingFilm = 1.5;

/// A problem at another speed; sliding goes in proportion.
PointProblem at_speed(PointProblem problem, double speed) {
  problem.sliding_speed *= speed / problem.entrainment_speed;
  problem.entrainment_speed = speed;
  return problem;
}

numerics::ContinuationSteps steps_of(double first) {
  return {.first = first, .smallest = kShortest * first, .keeps_end = true};
}

/// From one speed to that of the problem in equal factors.
PointWay change_speed(const PointProblem& problem, const PointFilm& film, double from) {
  const double distance = std::log(problem.entrainment_speed / from);
  return {.conditions_at =
              [&problem, &film, from, distance](double share) {
                const double speed = from * std::exp(share * distance);
                return conditions_of(at_speed(problem, speed), film);
              },
          .steps = steps_of(std::min(1.0, kLogStep / std::max(kLogStep, std::abs(distance))))};
}

/// From smooth bodies to those of the problem.
PointWay roughen(const PointProblem& problem, const PointFilm& film) {
  return {.conditions_at =
              [&problem, &film](double share) {
                PointConditions conditions = conditions_of(problem, film);
                if (problem.roughness.size() > 0) {
                  conditions.shape += (1 - share) * problem.roughness;
                }
                return conditions;
              },
          .steps = steps_of(1)};
}

/// u_m [m/s], not below that of the problem, at which a film of smooth bodies is as thick as the
/// roughness is high and clears the boundary film.
double clear_speed(const PointProblem& problem) {
  const double film = film_groups_of(problem).nijenbanning_central();
  const double rough = problem.roughness.size() == 0 ? 0 : numerics::rms_height(problem.roughness);
  const double clear =
      std::max(kClearance * rough, kBoundaryFilms * problem.asperities.boundary_film);
  const double factor = std::pow(clear / film, 1 / kFilmExponent);
  return problem.entrainment_speed * std::clamp(factor, 1.0, kFastest);
}

/// Smooth bodies; their pressure knows no cap.
Outcome solve_smooth(const PointProblem& problem, PointState& state, const Observer& observer) {
  PointProblem smooth = problem;
  smooth.roughness.resize(0, 0);
  smooth.plastic_pressure = kNoPlasticLimit;
  smooth.tolerance = std::max(problem.tolerance, kRoughly);
  PointFilm film(smooth);
  return solve_cold(smooth, film, state, observer);
}

/// A film of bodies that knew neither contact nor a cap on the pressure.
PointState capped(const PointProblem& problem, const PointFilm& film, PointState state) {
  state.pressure = state.pressure.min(problem.plastic_pressure);
  for (Index k = 0; k < state.nodes.size(); ++k) {
    if (!film.in_domain(k)) state.nodes.data()[k] = PointNode::cavity;
  }
  return state;
}

/// From coarser grids; where that fails, from smooth bodies whose roughness is raised.
Outcome solve_rough(const PointProblem& problem, const PointFilm& film, PointState& state,
                    const Observer& observer) {
  Outcome outcome = solve_nested(problem, film, solve_rough, state, observer);
  if (!outcome.convergence.failed()) return outcome;
  outcome = outcome + solve_smooth(problem, state, observer);
  state = capped(problem, film, state);
  if (!outcome.convergence.converged()) return outcome;
  return outcome + follow(film, roughen(problem, film), state, observer);
}

/// At a speed whose film is not much thinner than the roughness is high, then down to that of the
/// problem.
Outcome slow_down(const PointProblem& problem, const PointFilm& film, PointState& state,
                  const Observer& observer) {
  const double first_speed = clear_speed(problem);
  const bool is_slow = first_speed > problem.entrainment_speed;
  PointProblem first = at_speed(problem, first_speed);
  if (is_slow) first.tolerance = std::max(problem.tolerance, kRoughly);
  Outcome outcome = solve_rough(first, film, state, observer);
  if (is_slow && outcome.convergence.converged()) {
    outcome = outcome + follow(film, change_speed(problem, film, first_speed), state, observer);
  }
  return outcome;
}

PointNode node_of(double pressure, double film, double plastic_depth) {
  if (pressure <= 0) return PointNode::cavity;
  if (plastic_depth > 0) return film <= 0 ? PointNode::plastic_touching : PointNode::plastic;
  return film <= 0 ? PointNode::touching : PointNode::liquid;
}

/// The state of a result, which may be of another grid.
PointState mixed_state_of(const PointProblem& problem, const PointFilm& film,
                          const PointResult& result) {
  PointState state{.pressure = result.pressure,
                   .plastic_depth = Field::Zero(film.grid().ny, film.grid().nx),
                   .separation = result.separation,
                   .film = {},
                   .nodes = {}};
  if (result.contact_pressure.size() > 0) state.pressure += result.contact_pressure;
  const bool same_grid = result.grid == film.grid();
  if (!same_grid) {
    state.pressure = numerics::NodeTransfer(film.grid(), result.grid).to_fine(state.pressure);
  }
  state.nodes = nodes_of(state.pressure <= 0);
  state = capped(problem, film, state);
  if (!same_grid) return state;
  if (result.plastic_depth.size() > 0) state.plastic_depth = result.plastic_depth;
  for (Index k = 0; k < state.nodes.size(); ++k) {
    if (!film.in_domain(k)) continue;
    state.nodes.data()[k] =
        node_of(state.pressure.data()[k], result.film.data()[k], state.plastic_depth.data()[k]);
  }
  return state;
}

/// With what solids carry apart from the liquid.
PointResult mixed_result_of(const PointProblem& problem, const PointFilm& film,
                            const PointState& state, double speed, const Outcome& outcome) {
  const Mask touching = state.nodes != PointNode::cavity &&
                        state.film < kTouchingFilm * problem.asperities.boundary_film;
  const PointState liquid{.pressure = touching.select(0, state.pressure),
                          .plastic_depth = {},
                          .separation = state.separation,
                          .film = touching.select(0, state.film),
                          .nodes = {}};
  PointResult result = result_of(problem, film, liquid, outcome);
  const Mask solid = touching || state.plastic_depth > 0;
  if (solid.any()) result.contact_pressure = solid.select(state.pressure, 0);
  result.pressure = solid.select(0, result.pressure);
  if (std::isfinite(problem.plastic_pressure)) result.plastic_depth = state.plastic_depth;
  result.entrainment_speed = speed;
  return result;
}

}  // namespace

PointResult solve_point_mixed(const PointProblem& problem, const PointResult* start,
                              const Observer& observer) {
  check_point(problem);
  const PointFilm film(problem, {.solids_touch = true});
  PointState state;
  Outcome outcome;
  double speed = problem.entrainment_speed;
  if (start != nullptr) {
    state = mixed_state_of(problem, film, *start);
    const double from = start->entrainment_speed > 0 ? start->entrainment_speed : speed;
    const PointWay way = change_speed(problem, film, from);
    outcome = follow(film, way, state, observer);
    speed = way.conditions_at(1).speed;
  }
  if (outcome.convergence.failed()) {
    outcome = outcome + slow_down(problem, film, state, observer);
    speed = problem.entrainment_speed;
  }
  return mixed_result_of(problem, film, state, speed, outcome);
}

}  // namespace tabor::ehl
