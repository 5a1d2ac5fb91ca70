#include "tabor/ehl/point/mixed.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "tabor/ehl/point/mixed_film.hpp"
#include "tabor/ehl/point/start.hpp"
#include "tabor/numerics/field_statistics.hpp"

namespace tabor::ehl {
namespace {

using Outcome = PointFilm::Outcome;

constexpr double kRoughly = 1e-2;       // tolerance where a solution is only a start
constexpr double kClearance = 2;        // film of a smooth start, in rms heights
constexpr double kBoundaryFilms = 5;    // ... or in boundary films
constexpr double kFastest = 1e6;        // speed of a start over the one asked for, at most
constexpr double kFilmExponent = 0.67;  // film ~ speed^0.67, Hamrock & Dowson 1977
constexpr double kLogStep = 1.2;        // of the speed, at first: a factor of 3.3
constexpr double kSmallestStep = 1.0 / 32;

/// A way from a state to another: apply(share) sets the film up for a share 0..1 of it.
struct Way {
  std::function<void(double)> apply;
  double first_step = 1;
};

/// Leads `state` to the end of the way in steps that shrink where one fails; those before the last
/// are solved roughly. Stalled where they would be too short.
Outcome follow(MixedFilm& film, const Way& way, MixedState& state, const Observer& observer) {
  Outcome outcome;
  const double tolerance = film.tolerance;
  double share = 0;
  const double smallest_step = kSmallestStep * way.first_step;
  Convergence& convergence = outcome.convergence;
  for (double step = way.first_step; share < 1 && step > smallest_step && !convergence.stopped();) {
    MixedState next = state;
    const double aim = std::min(1.0, share + step);
    way.apply(aim);
    film.tolerance = aim < 1 ? std::max(tolerance, kRoughly) : tolerance;
    outcome = outcome + film.solve(next, observer);
    if (convergence.converged()) share = aim;
    if (convergence.converged() || aim >= 1) state = next;
    step *= convergence.converged() ? 1.5 : 0.5;
  }
  way.apply(1);
  film.tolerance = tolerance;
  if (convergence.failed()) convergence.status = Status::stalled;
  return outcome;
}

/// From one speed to another in equal factors.
Way change_speed(MixedFilm& film, double from, double to) {
  const double distance = std::log(to / from);
  return {.apply = [&film, from,
                    distance](double share) { film.set_speed(from * std::exp(share * distance)); },
          .first_step = std::min(1.0, kLogStep / std::max(kLogStep, std::abs(distance)))};
}

/// u_m [m/s] at which the film of smooth bodies clears the roughness and the boundary film.
double clear_speed(const PointProblem& problem) {
  const double film = film_groups_of(problem).nijenbanning_central();
  const double rough = problem.roughness.size() == 0 ? 0 : numerics::rms_height(problem.roughness);
  const double clear =
      std::max(kClearance * rough, kBoundaryFilms * problem.asperities.boundary_film);
  const double factor = std::pow(clear / film, 1 / kFilmExponent);
  return problem.entrainment_speed * std::clamp(factor, 1.0, kFastest);
}

/// Smooth bodies at a speed; their pressure knows no cap.
Outcome solve_smooth(const PointProblem& problem, double speed, PointState& state,
                     const Observer& observer) {
  PointProblem smooth = problem;
  smooth.roughness.resize(0, 0);
  smooth.plastic_pressure = kNoPlasticLimit;
  smooth.sliding_speed *= speed / problem.entrainment_speed;
  smooth.entrainment_speed = speed;
  smooth.tolerance = std::max(problem.tolerance, kRoughly);
  PointFilm film(smooth);
  return solve_cold(smooth, film, state, observer);
}

Outcome solve_from_smooth(const PointProblem& problem, MixedFilm& film, MixedState& state,
                          const Observer& observer) {
  const double first_speed = clear_speed(problem);
  PointState smooth;
  Outcome outcome = solve_smooth(problem, first_speed, smooth, observer);
  film.share_of_roughness = 0;
  film.set_speed(first_speed);
  state = film.state_from(smooth);
  const Way roughen{.apply = [&film](double share) { film.share_of_roughness = share; }};
  if (outcome.convergence.converged()) outcome = outcome + follow(film, roughen, state, observer);
  if (outcome.convergence.converged() && first_speed > problem.entrainment_speed) {
    const Way slow = change_speed(film, first_speed, problem.entrainment_speed);
    outcome = outcome + follow(film, slow, state, observer);
  }
  film.share_of_roughness = 1;
  film.set_speed(problem.entrainment_speed);
  return outcome;
}

}  // namespace

PointResult solve_point_mixed(const PointProblem& problem, const PointResult* start,
                              const Observer& observer) {
  check_point(problem);
  MixedFilm film(problem);
  MixedState state;
  Outcome outcome;
  if (start != nullptr) {
    state = film.state_from(*start);
    const double from =
        start->entrainment_speed > 0 ? start->entrainment_speed : problem.entrainment_speed;
    const Way way = change_speed(film, from, problem.entrainment_speed);
    outcome = follow(film, way, state, observer);
  }
  if (outcome.convergence.failed()) {
    outcome = outcome + solve_from_smooth(problem, film, state, observer);
  }
  return film.result_of(state, outcome);
}

}  // namespace tabor::ehl
