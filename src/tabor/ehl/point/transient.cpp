#include "tabor/ehl/point/transient.hpp"

#include <fmt/format.h>

#include <cmath>

#include "tabor/core/error.hpp"
#include "tabor/ehl/point/start.hpp"

namespace tabor::ehl {
namespace {

void check(const TransientPointProblem& problem) {
  check_point(problem.contact);
  if (problem.contact.roughness.size() > 0 || std::isfinite(problem.contact.plastic_pressure)) {
    throw InputError("contact of a transient film", "its own roughness or plastic pressure",
                     "smooth elastic bodies; the roughness moves beside them", "");
  }
  if (!problem.roughness) {
    throw InputError("roughness of a transient film", "none", "a map for every time", "");
  }
  if (!(problem.time_step > 0) || !std::isfinite(problem.time_step) || problem.steps < 1) {
    throw InputError("steps of a transient film",
                     fmt::format("{} of {} s", problem.steps, problem.time_step),
                     "one or more of a positive length", "");
  }
}

/// Gap of the undeformed bodies at a time [m].
Field shape_at(const TransientPointProblem& problem, const Field& smooth, double time) {
  const Field height = problem.roughness(time);
  if (height.rows() != smooth.rows() || height.cols() != smooth.cols() ||
      !height.isFinite().all()) {
    throw InputError("roughness of a transient film",
                     fmt::format("{} x {} values at {} s", height.rows(), height.cols(), time),
                     fmt::format("{} x {}, without holes", smooth.rows(), smooth.cols()), "");
  }
  return smooth - height;
}

PointMoment moment_of(const PointFilm& film, const PointState& state, double time) {
  Index row = 0;
  Index column = 0;
  film.y().abs().minCoeff(&row);
  film.x().abs().minCoeff(&column);
  return {.time = time,
          .central_film = state.film(row, column),
          .min_film = state.film.minCoeff(),
          .max_pressure = state.pressure.maxCoeff()};
}

}  // namespace

TransientPointResult solve_point_transient(const TransientPointProblem& problem,
                                           const Observer& observer) {
  check(problem);
  const PointFilm film(problem.contact);
  const Field& smooth = film.conditions().shape;
  PointConditions now = film.conditions();
  TransientPointResult result;
  PointState state;
  PointFilm::Outcome outcome = solve_cold(problem.contact, film, state, observer);
  now.shape = shape_at(problem, smooth, 0);
  if (outcome.convergence.converged()) outcome = outcome + film.solve(state, now, {}, observer);
  if (!outcome.convergence.converged()) {
    result.history.push_back(moment_of(film, state, 0));
    result.last = result_of(problem.contact, film, state, outcome);
  }
  for (int step = 0; outcome.convergence.converged(); ++step) {
    const double time = step * problem.time_step;
    result.history.push_back(moment_of(film, state, time));
    result.last = result_of(problem.contact, film, state, outcome);
    if (step == problem.steps) break;
    const PointStorage storage{.time_step = problem.time_step, .old_mass = film.mass_of(state)};
    now.shape = shape_at(problem, smooth, time + problem.time_step);
    outcome = outcome + film.solve(state, now, storage, observer);
  }
  result.convergence = outcome.convergence;
  return result;
}

}  // namespace tabor::ehl
