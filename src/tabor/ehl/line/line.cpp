#include "tabor/ehl/line/line.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "tabor/core/checks.hpp"
#include "tabor/core/error.hpp"
#include "tabor/core/units.hpp"
#include "tabor/ehl/film.hpp"
#include "tabor/ehl/line/film.hpp"
#include "tabor/ehl/plain.hpp"
#include "tabor/numerics/continuation.hpp"

namespace tabor::ehl {
namespace {

constexpr int kMaxIterations = 40;
constexpr double kMinNodesPerHalfWidth = 8;
/// The film of the first guess over Moes': Newton's method comes down safely from a thick film,
/// where the flow depends on the pressure gradient, and may jump far from a thin one.
constexpr double kFirstFilms[] = {10, 3, 40};

void check_domain(const LineProblem& problem) {
  const double half_width = hertz_of(problem).half_width;
  const Eigen::ArrayXd x = line_nodes(problem);
  const double beside_centre = std::min(-x[0], x[x.size() - 1]);
  if (!(beside_centre > half_width)) {
    throw InputError("domain of a line contact",
                     format_si(beside_centre, "m") + " beside the centre",
                     "more than the half width of Hertz, " + format_si(half_width, "m"),
                     "make the domain longer, or leave it out");
  }
  const double spacing = x[1] - x[0];
  const double film = film_groups_of(problem).moes_min_film();
  const double width = half_width + std::sqrt(2 * problem.radius * film);
  if (!(width >= kMinNodesPerHalfWidth * spacing)) {
    throw InputError(
        "grid of a line contact",
        fmt::format("{} nodes, {} apart", problem.nodes, format_si(spacing, "m")),
        fmt::format("{} nodes in the half width, {}", kMinNodesPerHalfWidth, format_si(width, "m")),
        "give more nodes or a shorter domain");
  }
}

/// A film whose inlet is not on the grid is no solution.
void require_inlet(const LineProblem& problem, const LineFilm& film, const LineState& state,
                   LineFilm::Outcome& outcome) {
  if (outcome.convergence.converged() && !sees_inlet(problem, film.x(), state.film)) {
    outcome.convergence.status = Status::stalled;
  }
}

/// From Hertz' pressure and a film `first` times that of Moes.
LineFilm::Outcome solve_from_hertz(const LineProblem& problem, const LineFilm& film,
                                   const LineConditions& conditions, double first, LineState& state,
                                   const Observer& observer) {
  state = film.hertz_start(first * film_groups_of(problem).moes_min_film(), conditions);
  LineFilm::Outcome outcome = film.solve(state, conditions, {}, kMaxIterations, observer);
  require_inlet(problem, film, state, outcome);
  return outcome;
}

/// Leads a film from the conditions of share 0 to those of share 1. `found`, if it is not null,
/// becomes the last share at which there was one.
LineFilm::Outcome lead(const LineFilm& film, LineState& state,
                       const std::function<LineConditions(double)>& conditions_at, double* found,
                       const Observer& observer) {
  if (found != nullptr) *found = 0;
  return numerics::follow(state, {}, [&](LineState& next, double share) {
    LineFilm::Outcome outcome =
        film.solve(next, conditions_at(share), {}, kMaxIterations, observer);
    if (found != nullptr && outcome.convergence.converged()) *found = share;
    return outcome;
  });
}

/// From the pressure of Hertz; with asperities if they touch, or if that fails.
LineFilm::Outcome solve_directly(const LineProblem& problem, const LineFilm& film,
                                 const LineConditions& conditions, LineState& state,
                                 const Observer& observer) {
  LineFilm::Outcome outcome;
  for (const double first : kFirstFilms) {
    outcome = outcome + solve_from_hertz(problem, film, conditions, first, state, observer);
    const bool is_open = outcome.convergence.converged() &&
                         state.film.minCoeff() >= problem.asperities.boundary_film;
    if (film.has_asperities() && !is_open && !outcome.convergence.stopped()) {
      outcome = outcome + film.solve_touching(state, conditions, observer);
    }
    if (!outcome.convergence.failed() || film.has_asperities()) break;
  }
  return outcome;
}

/// From Hertz' pressure; if that fails, from a viscosity that does not grow with pressure.
LineFilm::Outcome solve_as_shaped(const LineProblem& problem, const LineFilm& film,
                                  const LineConditions& conditions, LineState& state,
                                  const Observer& observer) {
  LineFilm::Outcome outcome = solve_directly(problem, film, conditions, state, observer);
  if (!outcome.convergence.failed()) return outcome;
  if (!(material::pressure_coefficient(conditions.lubricant.viscosity) > 0)) return outcome;
  const auto thicken = [&](double share) {
    LineConditions thinner = conditions;
    thinner.lubricant = with_share_of_coefficient(conditions.lubricant, share);
    return thinner;
  };
  outcome = outcome + solve_directly(problem, film, thicken(0), state, observer);
  if (!outcome.convergence.converged()) return outcome;
  return outcome + lead(film, state, thicken, nullptr, observer);
}

/// Solves from the film of smooth bodies where rough ones fail. `roughness_share`: what the film is
/// left with where it is lost on the way from there.
LineFilm::Outcome solve_cold(const LineProblem& problem, const LineFilm& film, LineState& state,
                             double& roughness_share, const Observer& observer) {
  const LineConditions& asked = film.conditions();
  if (problem.roughness.size() == 0) return solve_as_shaped(problem, film, asked, state, observer);
  LineFilm::Outcome outcome = solve_directly(problem, film, asked, state, observer);
  if (!outcome.convergence.failed()) return outcome;
  const auto roughen = [&](double share) {
    LineConditions conditions = asked;
    conditions.shape += (1 - share) * problem.roughness;
    return conditions;
  };
  outcome = outcome + solve_as_shaped(problem, film, roughen(0), state, observer);
  if (!outcome.convergence.converged()) return outcome;
  return outcome + lead(film, state, roughen, &roughness_share, observer);
}

}  // namespace

reference::HertzLineContact hertz_of(const LineProblem& problem) {
  return reference::hertz_line_at_load(problem.radius, problem.effective_modulus, problem.load);
}

reference::LineContactFilm film_groups_of(const LineProblem& problem) {
  return {.radius = problem.radius,
          .effective_modulus = problem.effective_modulus,
          .load = problem.load,
          .entrainment_speed = problem.entrainment_speed,
          .viscosity = material::ambient_viscosity(problem.lubricant.viscosity),
          .pressure_coefficient = material::pressure_coefficient(problem.lubricant.viscosity)};
}

Eigen::ArrayXd line_nodes(const LineProblem& problem) {
  const double half_width = hertz_of(problem).half_width;
  const double film = film_groups_of(problem).moes_min_film();
  const double rigid = std::sqrt(2 * problem.radius * film);
  // Pressure reaches far before a rigid cylinder: 10 lengths would lose 2.3 % of the film, 30 lose
  // 0.3 %.
  const double usual = std::max(4 * half_width + 10 * rigid, 30 * rigid);
  const double inlet = problem.inlet > 0 ? problem.inlet : usual;
  const double outlet = problem.outlet > 0 ? problem.outlet : 1.5 * half_width + 3 * rigid;
  return Eigen::ArrayXd::LinSpaced(problem.nodes, -inlet, outlet);
}

void check_line(const LineProblem& problem) {
  check_positive("radius", problem.radius, "m");
  check_positive("load", problem.load, "N/m");
  check_positive("effective modulus", problem.effective_modulus, "Pa");
  check_positive("entrainment speed", problem.entrainment_speed, "m/s");
  if (problem.cavitation == LineCavitation::penalty) check_positive("penalty", problem.penalty, "");
  if (problem.nodes < 3) {
    throw InputError("nodes of a line contact", fmt::format("{}", problem.nodes), "3 or more", "");
  }
  if (problem.roughness.size() > 0 && problem.roughness.size() != problem.nodes) {
    throw InputError("roughness", fmt::format("{} values", problem.roughness.size()),
                     fmt::format("{}, one per node", problem.nodes), "");
  }
  const double half_width = hertz_of(problem).half_width;
  if (!(half_width < problem.radius)) {
    throw InputError("load of a line contact", fmt::format("{} N/m", problem.load),
                     fmt::format("a contact narrower than its radius, {} m", problem.radius),
                     "the theory holds only for small deformations");
  }
  material::check_pressure(problem.lubricant, hertz_of(problem).max_pressure);
  check(problem.asperities);
  check_domain(problem);
}

namespace {

LineResult solve(const LineProblem& problem, const LineFilm& film, const Observer& observer) {
  LineState state;
  LineResult result;
  LineFilm::Outcome outcome = solve_cold(problem, film, state, result.roughness_share, observer);
  require_inlet(problem, film, state, outcome);
  result.x = film.x();
  result.pressure = state.pressure;
  result.film = state.film;
  result.separation = state.separation;
  result.convergence = outcome.convergence;
  result.mass_error = outcome.mass_error;
  result.load_error = outcome.load_error;
  result.contact_error = outcome.contact_error;
  if (film.has_asperities()) result.asperity_pressure = film.touching_pressure(state);
  measure_line(problem, result);
  return result;
}

}  // namespace

LineResult solve_line(const LineProblem& problem, const Observer& observer) {
  check_line(problem);
  return solve(problem, LineFilm(problem), observer);
}

LineResult solve_line_plainly(const LineProblem& problem) {
  check_line(problem);
  return solve(problem, LineFilm(problem, true), {});
}

}  // namespace tabor::ehl
