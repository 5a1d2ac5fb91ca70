#include "tabor/ehl/line.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "tabor/core/error.hpp"
#include "tabor/ehl/ball_film.hpp"
#include "tabor/ehl/line_film.hpp"

namespace tabor::ehl {
namespace {

constexpr int kMaxIterations = 40;
constexpr double kMinNodesPerHalfWidth = 8;
/// The film of the first guess over Moes': Newton's method comes down safely from a thick film,
/// where the flow depends on the pressure gradient, and may jump far from a thin one.
constexpr double kFirstFilms[] = {10, 3, 40};
constexpr double kFewestInletNodes = 0.1;
constexpr double kFirstStep = 0.5;  // of the continuation in the pressure coefficient
constexpr double kSmallestStep = 1.0 / 64;

void check_positive(const char* what, double value, const char* unit) {
  if (!(value > 0) || !std::isfinite(value)) {
    throw InputError(what, fmt::format("{} {}", value, unit), "more than zero", "");
  }
}

void check_domain(const LineProblem& problem) {
  const double half_width = hertz_of(problem).half_width;
  const Eigen::ArrayXd x = line_nodes(problem);
  const double room = std::min(-x[0], x[x.size() - 1]);
  if (!(room > half_width)) {
    throw InputError("domain of a line contact", fmt::format("{:.4g} m beside the centre", room),
                     fmt::format("more than the half width of Hertz, {:.4g} m", half_width),
                     "make the domain longer or leave it to the program");
  }
  const double spacing = x[1] - x[0];
  const double film = film_groups_of(problem).moes_min_film();
  const double width = half_width + std::sqrt(2 * problem.radius * film);
  if (!(width >= kMinNodesPerHalfWidth * spacing)) {
    throw InputError(
        "grid of a line contact", fmt::format("{} nodes, {:.4g} m apart", problem.nodes, spacing),
        fmt::format("{} nodes in the half width, {:.4g} m", kMinNodesPerHalfWidth, width),
        "give more nodes or a shorter domain");
  }
}

/// Length of the inlet over which the film is built up, where the gap of Hertz is as large as the
/// film [m].
double inlet_length(const LineProblem& problem, double film) {
  const double half_width = hertz_of(problem).half_width;
  const double elastic =
      std::pow(film * problem.radius / (half_width * half_width), 2.0 / 3) * half_width;
  return std::min(elastic, std::sqrt(2 * problem.radius * film));
}

/// Nodes in the inlet of a film of this thickness.
double inlet_nodes(const LineProblem& problem, double film, double spacing) {
  return inlet_length(problem, film) / spacing;
}

/// Whether the inlet of the film that was found exists on the grid. Where it does not, a film a
/// thousand times too thin can balance as well, and Newton's method may come to it.
bool sees_inlet(const LineProblem& problem, const LineFilm& film, const LineState& state) {
  const Eigen::ArrayXd& x = film.x();
  const double spacing = x[1] - x[0];
  const double half_width = std::max(spacing, hertz_of(problem).half_width);
  const Eigen::ArrayXd inside = (x.abs() <= half_width).cast<double>();
  const double thickness = (inside * state.film).sum() / inside.sum();
  return state.film.minCoeff() > 0 && inlet_nodes(problem, thickness, spacing) >= kFewestInletNodes;
}

std::vector<std::string> doubts_of(const LineProblem& problem, const LineResult& result) {
  std::vector<std::string> doubts = material::doubts(problem.lubricant, result.max_pressure);
  const double nodes =
      inlet_nodes(problem, film_groups_of(problem).moes_min_film(), result.x[1] - result.x[0]);
  if (nodes < 2) {
    doubts.push_back(fmt::format(
        "the grid has {:.2g} nodes where the film is built up: its thickness is uncertain; give "
        "about {:.2g} times as many nodes",
        nodes, 3 / nodes));
  }
  return doubts;
}

LineFilm::Outcome operator+(const LineFilm::Outcome& before, LineFilm::Outcome now) {
  now.iterations += before.iterations;
  now.n_products += before.n_products;
  return now;
}

/// From Hertz' pressure and films of some thickness.
LineFilm::Outcome solve_from_hertz(const LineProblem& problem, const LineFilm& film,
                                   LineState& state, const Observer& observer) {
  const double moes_film = film_groups_of(problem).moes_min_film();
  LineFilm::Outcome outcome;
  for (const double first : kFirstFilms) {
    state = film.hertz_start(first * moes_film);
    outcome = outcome + film.solve(state, {}, kMaxIterations, observer);
    outcome.converged = outcome.converged && sees_inlet(problem, film, state);
    if (outcome.converged) break;
  }
  return outcome;
}

material::Viscosity with_share_of_coefficient(const material::Viscosity& viscosity, double share) {
  return material::make_viscosity(material::law_of(viscosity),
                                  material::ambient_viscosity(viscosity),
                                  share * material::pressure_coefficient(viscosity));
}

/// Leads a film from share 0 to share 1 of what `apply` sets, in steps that shrink when one fails.
LineFilm::Outcome ramp(LineFilm& film, LineState& state, const std::function<void(double)>& apply,
                       const Observer& observer) {
  LineFilm::Outcome outcome;
  double share = 0;
  for (double step = kFirstStep; share < 1 && step > kSmallestStep;) {
    LineState next = state;
    const double aim = std::min(1.0, share + step);
    apply(aim);
    outcome = outcome + film.solve(next, {}, kMaxIterations, observer);
    if (outcome.converged) {
      state = next;
      share = aim;
    }
    step *= outcome.converged ? 1.5 : 0.5;
  }
  apply(1);
  outcome.converged = share >= 1;
  return outcome;
}

/// From Hertz' pressure; if that fails, from the film of smooth bodies and, if that fails too, of a
/// viscosity that does not grow with pressure.
LineFilm::Outcome solve_cold(const LineProblem& problem, LineFilm& film,
                             const Eigen::ArrayXd& roughness, LineState& state,
                             const Observer& observer) {
  LineFilm::Outcome outcome = solve_from_hertz(problem, film, state, observer);
  if (outcome.converged) return outcome;
  if (roughness.size() > 0) {
    const Eigen::ArrayXd rough = film.shape;
    film.shape = rough + roughness;
    outcome = outcome + solve_cold(problem, film, {}, state, observer);
    if (!outcome.converged) return outcome;
    const auto roughen = [&](double share) { film.shape = rough + (1 - share) * roughness; };
    return outcome + ramp(film, state, roughen, observer);
  }
  const material::Viscosity viscosity = film.lubricant.viscosity;
  if (!(material::pressure_coefficient(viscosity) > 0)) return outcome;
  film.lubricant.viscosity = with_share_of_coefficient(viscosity, 0);
  outcome = outcome + solve_from_hertz(problem, film, state, observer);
  if (!outcome.converged) return outcome;
  const auto thicken = [&](double share) {
    film.lubricant.viscosity = with_share_of_coefficient(viscosity, share);
  };
  return outcome + ramp(film, state, thicken, observer);
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
  const double inlet = problem.inlet > 0 ? problem.inlet : 4 * half_width + 10 * rigid;
  const double outlet = problem.outlet > 0 ? problem.outlet : 1.5 * half_width + 3 * rigid;
  return Eigen::ArrayXd::LinSpaced(problem.nodes, -inlet, outlet);
}

/// Rounding may leave a trace of pressure in the cavity: the film ends before it.
constexpr double kFilmEnd = 1e-6;

void measure_line(const LineProblem& problem, LineResult& result) {
  const double spacing = result.x[1] - result.x[0];
  result.min_film = smallest_film(result.film);
  result.central_film = value_between_nodes(result.x, result.film, 0);
  result.max_pressure = result.pressure.maxCoeff();
  material::NodeLaws laws;
  const auto n = static_cast<std::size_t>(result.pressure.size());
  material::evaluate(problem.lubricant, {result.pressure.data(), n}, laws);
  result.friction_force = 0;
  for (Index i = 0; i < result.x.size(); ++i) {
    if (!(result.pressure[i] > 0)) continue;
    if (result.pressure[i] > kFilmEnd * result.max_pressure) result.rupture = result.x[i];
    const double rate = problem.sliding_speed / result.film[i];
    const double stress =
        material::shear_stress(problem.lubricant.shear, laws.viscosity[i], rate, result.pressure[i])
            .value;
    result.friction_force += spacing * stress;
    result.max_shear_stress = std::max(result.max_shear_stress, std::abs(stress));
  }
  result.friction_coefficient = result.friction_force / problem.load;
  result.doubts = doubts_of(problem, result);
}

void check_line(const LineProblem& problem) {
  check_positive("radius", problem.radius, "m");
  check_positive("load", problem.load, "N/m");
  check_positive("effective modulus", problem.effective_modulus, "Pa");
  check_positive("entrainment speed", problem.entrainment_speed, "m/s");
  if (problem.cavitation == LineCavitation::penalty) {
    check_positive("penalty", problem.penalty, "");
  }
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
                     "the theory of small deformations ends before");
  }
  material::check_pressure(problem.lubricant, hertz_of(problem).max_pressure);
  check_domain(problem);
}

LineResult solve_line(const LineProblem& problem, const Observer& observer) {
  check_line(problem);
  LineFilm film(problem);
  LineState state;
  const LineFilm::Outcome outcome = solve_cold(problem, film, problem.roughness, state, observer);
  LineResult result;
  result.x = film.x();
  result.pressure = state.pressure;
  result.film = state.film;
  result.separation = state.separation;
  result.newton_iterations = outcome.iterations;
  result.n_products = outcome.n_products;
  result.converged = outcome.converged && sees_inlet(problem, film, state);
  result.mass_error = outcome.mass_error;
  result.load_error = outcome.load_error;
  measure_line(problem, result);
  return result;
}

}  // namespace tabor::ehl
