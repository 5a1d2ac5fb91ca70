#include "tabor/ehl/point/start.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "tabor/core/units.hpp"
#include "tabor/ehl/film.hpp"
#include "tabor/ehl/point/accuracy.hpp"

namespace tabor::ehl {
namespace {

constexpr Index kCoarsest = 48;  // nodes along a side of a grid that is not coarsened further
/// The film of the first guess over that of Nijenbanning's formula: Newton's method comes down
/// safely from a thick film, where the flow depends on the pressure gradient.
constexpr double kFirstFilms[] = {3, 10, 1, 30};
constexpr int kStepsInTime = 7;         // the first one while liquid crosses a cell
constexpr double kStepGrowth = 3;       // of a step over the one before
constexpr double kStepTolerance = 0.1;  // of a film on the way
constexpr double kInletLengths = 4;
constexpr double kLargeError = 0.02;  // of the film, worth a warning

PointFilm::Outcome solve_from_hertz(const PointFilm& film, const PointConditions& conditions,
                                    PointState& state, const Observer& observer) {
  PointFilm::Outcome outcome;
  for (const double first : kFirstFilms) {
    state = film.hertz_start(first * film.film_scale());
    outcome = outcome + film.solve(state, conditions, {}, observer);
    if (!outcome.convergence.failed()) break;
  }
  return outcome;
}

/// The problem on a grid of twice the spacing, to be solved roughly; none where that is too coarse.
/// Waves that it cannot hold are averaged out.
std::optional<PointProblem> coarser(const PointProblem& problem) {
  PointProblem coarse = problem;
  coarse.nodes_x = (problem.nodes_x + 1) / 2;
  coarse.nodes_y = (problem.nodes_y + 1) / 2;
  coarse.tolerance = std::max(problem.tolerance, kRoughly);
  if (std::min(coarse.nodes_x, coarse.nodes_y) < kCoarsest) return std::nullopt;
  if (problem.roughness.size() > 0) {
    const numerics::NodeTransfer transfer(point_grid(problem), point_grid(coarse));
    coarse.roughness = transfer.mean(problem.roughness);
  }
  return coarse;
}

/// Steps in time until the film hardly changes, then solves for the steady one (pseudo-transient
/// continuation, Kelley & Keyes 1998). The flow grows with the cube of the film, so the thicker a
/// thin film beside a plastic node is, the more it takes in. Without time, Newton's equations ask
/// there for a negative pressure, where the liquid would fill the gap.
PointFilm::Outcome settle_in_time(const PointFilm& film, const PointConditions& asked,
                                  PointState& state, const Observer& observer) {
  PointConditions conditions = asked;
  conditions.tolerance = std::max(asked.tolerance, kStepTolerance);
  double step = film.grid().dx() / asked.speed;  // [s]
  PointFilm::Outcome outcome;
  for (int i = 0; i < kStepsInTime; ++i, step *= kStepGrowth) {
    const PointStorage storage{.time_step = step, .old_mass = film.first_mass(state, conditions)};
    outcome = outcome + film.solve(state, conditions, storage, observer);
    if (!outcome.convergence.converged()) return outcome;
  }
  return outcome + film.solve(state, asked, {}, observer);
}

/// Solves for the steady film; where that fails and solids may touch, by way of steps in time.
PointFilm::Outcome solve_steady(const PointFilm& film, const PointConditions& conditions,
                                PointState& state, const Observer& observer) {
  const PointState begin = state;
  const PointFilm::Outcome outcome = film.solve(state, conditions, {}, observer);
  if (!film.options().solids_touch || !outcome.convergence.failed()) return outcome;
  state = begin;
  return outcome + settle_in_time(film, conditions, state, observer);
}

Warnings warnings_of(const PointProblem& problem, const PointResult& result) {
  Warnings warnings = material::warnings(problem.lubricant, result.pressure.maxCoeff());
  const double on_grid = point_grid_error(problem);
  if (on_grid > kLargeError) {
    warnings.push_back(
        {"coarse-grid",
         fmt::format("The grid makes the central film too thin by about {}. Use {:.2g} times as "
                     "many nodes for 1 %",
                     percent(on_grid, 2), std::sqrt(on_grid / 0.01)),
         on_grid});
  }
  const double on_domain = point_domain_error(problem);
  if (on_domain > kLargeError) {
    warnings.push_back(
        {"short-domain",
         fmt::format("The domain cuts off pressure that carries load, so the central film is too "
                     "thin by about {}. Give grid.domain = \"auto\"",
                     percent(on_domain, 2)),
         on_domain});
  }
  const double half_axis = hertz_of(problem).half_axis_x;
  const double length =
      std::sqrt(2 * problem.radius_x * film_groups_of(problem).nijenbanning_central());
  const double inlet = (problem.inlet - 1) * half_axis / length;
  if (inlet < kInletLengths && !(on_domain > kLargeError)) warnings.push_back(short_inlet(inlet));
  const Index nx = result.grid.nx;
  if (result.pressure.col(nx - 2).maxCoeff() > 0) {
    warnings.push_back(
        {"short-outlet", "The film reaches the end of the domain. Give a longer outlet"});
  }
  return warnings;
}

}  // namespace

PointFilm::Outcome operator+(const PointFilm::Outcome& before, PointFilm::Outcome now) {
  now.convergence = after(before.convergence, now.convergence);
  now.n_linear_iterations += before.n_linear_iterations;
  return now;
}

PointConditions conditions_of(const PointProblem& problem, const PointFilm& film) {
  PointConditions conditions = film.conditions();
  conditions.speed = problem.entrainment_speed;
  conditions.sliding_speed = problem.sliding_speed;
  conditions.tolerance = problem.tolerance;
  return conditions;
}

PointFilm::Outcome solve_nested(const PointProblem& problem, const PointFilm& film,
                                const PointSolver& solve_coarse, PointState& state,
                                const Observer& observer) {
  const auto coarse = coarser(problem);
  if (!coarse) return {};
  const PointFilm coarse_film(*coarse, film.options());
  const PointFilm::Outcome before = solve_coarse(*coarse, coarse_film, state, observer);
  state = film.resampled(state, coarse_film.grid());
  if (!before.convergence.converged()) return before;
  return before + solve_steady(film, conditions_of(problem, film), state, observer);
}

PointFilm::Outcome follow(const PointFilm& film, const PointWay& way, PointState& state,
                          const Observer& observer) {
  return numerics::follow(state, way.steps, [&](PointState& next, double share) {
    PointConditions conditions = way.conditions_at(share);
    if (share < 1) conditions.tolerance = std::max(conditions.tolerance, kRoughly);
    return solve_steady(film, conditions, next, observer);
  });
}

PointFilm::Outcome solve_cold(const PointProblem& problem, const PointFilm& film, PointState& state,
                              const Observer& observer) {
  const PointConditions& asked = film.conditions();
  PointFilm::Outcome outcome = solve_nested(problem, film, solve_cold, state, observer);
  if (outcome.convergence.failed()) {
    outcome = outcome + solve_from_hertz(film, asked, state, observer);
  }
  const bool has_another_way = material::pressure_coefficient(asked.lubricant.viscosity) > 0;
  if (!outcome.convergence.failed() || !has_another_way) return outcome;
  const auto thicken = [&](double share) {
    PointConditions thinner = asked;
    thinner.lubricant = with_share_of_coefficient(asked.lubricant, share);
    return thinner;
  };
  outcome = outcome + solve_from_hertz(film, thicken(0), state, observer);
  if (!outcome.convergence.converged()) return outcome;
  return outcome + follow(film, {.conditions_at = thicken}, state, observer);
}

PointState state_of(const PointFilm& film, const PointResult& result) {
  return film.resampled({.pressure = result.pressure,
                         .plastic_depth = Field::Zero(result.grid.ny, result.grid.nx),
                         .separation = result.separation,
                         .film = result.film,
                         .nodes = nodes_of(result.pressure <= 0)},
                        result.grid);
}

PointResult result_of(const PointProblem& problem, const PointFilm& film, const PointState& state,
                      const PointFilm::Outcome& outcome) {
  PointResult result{.grid = film.grid(),
                     .pressure = state.pressure,
                     .contact_pressure = {},
                     .film = state.film,
                     .plastic_depth = {},
                     .separation = state.separation,
                     .load_error = outcome.load_error,
                     .mass_error = outcome.mass_error,
                     .convergence = outcome.convergence,
                     .n_linear_iterations = outcome.n_linear_iterations,
                     .warnings = {}};
  result.warnings = warnings_of(problem, result);
  return result;
}

}  // namespace tabor::ehl
