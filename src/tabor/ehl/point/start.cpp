#include "tabor/ehl/point/start.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace tabor::ehl {
namespace {

constexpr Index kCoarsest = 48;  // nodes along a side of a grid that is not coarsened further
/// The film of the first guess over that of Nijenbanning's formula: Newton's method comes down
/// safely from a thick film, where the flow depends on the pressure gradient.
constexpr double kFirstFilms[] = {3, 10, 1, 30};
constexpr double kRoughly = 1e-2;  // tolerance where a solution is only a start
constexpr double kInletLengths = 4;
constexpr double kFirstStep = 0.5;
constexpr double kSmallestStep = 1.0 / 64;

PointFilm::Outcome solve_from_hertz(const PointProblem& problem, PointFilm& film, PointState& state,
                                    const Observer& observer) {
  const double scale = film_groups_of(problem).nijenbanning_central();
  PointFilm::Outcome outcome;
  for (const double first : kFirstFilms) {
    state = film.hertz_start(first * scale);
    outcome = outcome + film.solve(state, {}, observer);
    if (!outcome.convergence.failed()) break;
  }
  return outcome;
}

material::Viscosity with_share_of_coefficient(const material::Viscosity& viscosity, double share) {
  return material::make_viscosity(material::law_of(viscosity),
                                  material::ambient_viscosity(viscosity),
                                  share * material::pressure_coefficient(viscosity));
}

/// Leads a film from share 0 to share 1 of what `apply` sets, in steps that shrink when one fails;
/// those before the last are solved roughly. Stalled where they would be too short.
PointFilm::Outcome ramp(PointFilm& film, PointState& state,
                        const std::function<void(double)>& apply, const Observer& observer) {
  PointFilm::Outcome outcome;
  const double tolerance = film.tolerance;
  double share = 0;
  Convergence& convergence = outcome.convergence;
  for (double step = kFirstStep; share < 1 && step > kSmallestStep && !convergence.stopped();) {
    PointState next = state;
    const double aim = std::min(1.0, share + step);
    apply(aim);
    film.tolerance = aim < 1 ? std::max(tolerance, kRoughly) : tolerance;
    outcome = outcome + film.solve(next, {}, observer);
    if (convergence.converged()) {
      state = next;
      share = aim;
    }
    step *= convergence.converged() ? 1.5 : 0.5;
  }
  apply(1);
  film.tolerance = tolerance;
  if (convergence.failed()) convergence.status = Status::stalled;
  return outcome;
}

/// From the solution on a grid of twice the spacing, if there is one.
PointFilm::Outcome solve_nested(const PointProblem& problem, PointFilm& film, PointState& state,
                                const Observer& observer) {
  PointProblem coarse = problem;
  coarse.nodes_x = (problem.nodes_x + 1) / 2;
  coarse.nodes_y = (problem.nodes_y + 1) / 2;
  if (std::min(coarse.nodes_x, coarse.nodes_y) < kCoarsest) return {};
  PointFilm coarse_film(coarse, film.coarsens());
  coarse_film.lubricant = film.lubricant;
  coarse_film.tolerance = std::max(film.tolerance, kRoughly);
  const PointFilm::Outcome before = solve_cold(coarse, coarse_film, state, observer);
  state = film.resampled(state, coarse_film.grid());
  return before.convergence.converged() ? before + film.solve(state, {}, observer) : before;
}

Index centre_column(const PointProblem& problem) {
  const double place = problem.inlet / (problem.inlet + problem.outlet);
  return static_cast<Index>(std::lround(place * static_cast<double>(problem.nodes_x - 1)));
}

std::vector<std::string> warnings_of(const PointProblem& problem, const PointResult& result) {
  std::vector<std::string> warnings =
      material::warnings(problem.lubricant, result.pressure.maxCoeff());
  const Index nx = result.grid.nx;
  const double half_axis = hertz_of(problem).half_axis_x;
  const double length =
      std::sqrt(2 * problem.radius_x * result.film(result.grid.ny / 2, centre_column(problem)));
  const double inlet = (problem.inlet - 1) * half_axis / length;
  if (inlet < kInletLengths) {
    warnings.push_back(
        fmt::format("the inlet is {:.2g} lengths sqrt(2 R h) long: a longer one may change the "
                    "film by some per cent",
                    inlet));
  }
  if (result.pressure.col(nx - 2).maxCoeff() > 0) {
    warnings.emplace_back("the film reaches the end of the domain: give a longer outlet");
  }
  return warnings;
}

}  // namespace

PointFilm::Outcome operator+(const PointFilm::Outcome& before, PointFilm::Outcome now) {
  now.convergence = after(before.convergence, now.convergence);
  now.n_linear_iterations += before.n_linear_iterations;
  return now;
}

PointFilm::Outcome solve_cold(const PointProblem& problem, PointFilm& film, PointState& state,
                              const Observer& observer) {
  PointFilm::Outcome outcome = solve_nested(problem, film, state, observer);
  if (outcome.convergence.failed()) {
    outcome = outcome + solve_from_hertz(problem, film, state, observer);
  }
  const material::Viscosity viscosity = film.lubricant.viscosity;
  const bool has_another_way = material::pressure_coefficient(viscosity) > 0;
  if (!outcome.convergence.failed() || !has_another_way) return outcome;
  film.lubricant.viscosity = with_share_of_coefficient(viscosity, 0);
  outcome = outcome + solve_from_hertz(problem, film, state, observer);
  const auto thicken = [&](double share) {
    film.lubricant.viscosity = with_share_of_coefficient(viscosity, share);
  };
  if (outcome.convergence.converged()) return outcome + ramp(film, state, thicken, observer);
  thicken(1);
  return outcome;
}

PointState state_of(const PointFilm& film, const PointResult& result) {
  return film.resampled({.pressure = result.pressure,
                         .separation = result.separation,
                         .film = result.film,
                         .cavity = result.pressure <= 0},
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
