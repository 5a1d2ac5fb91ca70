#include "tabor/ehl/line.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

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

void check_length(const LineProblem& problem, const Eigen::ArrayXd& x, const char* what,
                  double length) {
  const double shortest = kMinNodesPerHalfWidth * (x[1] - x[0]);
  if (!(length >= shortest)) {
    throw InputError(what, fmt::format("{:.4g} m", length),
                     fmt::format("{:.4g} m or more with {} nodes", shortest, problem.nodes),
                     "give more nodes");
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

double interpolated(const Eigen::ArrayXd& x, const Eigen::ArrayXd& y, double at) {
  const double place = (at - x[0]) / (x[1] - x[0]);
  const Index i = std::clamp(static_cast<Index>(place), Index{0}, x.size() - 2);
  const double share = place - static_cast<double>(i);
  return (1 - share) * y[i] + share * y[i + 1];
}

std::vector<std::string> doubts_of(const LineProblem& problem, const LineResult& result) {
  std::vector<std::string> doubts = material::doubts(problem.lubricant, result.max_pressure);
  const double nodes =
      inlet_length(problem, film_groups_of(problem).moes_min_film()) / (result.x[1] - result.x[0]);
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
LineFilm::Outcome solve_from_hertz(const LineFilm& film, double moes_film, LineState& state,
                                   const Observer& observer) {
  LineFilm::Outcome outcome;
  for (const double first : kFirstFilms) {
    state = film.hertz_start(first * moes_film);
    outcome = outcome + film.solve(state, {}, kMaxIterations, observer);
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
LineFilm::Outcome solve_cold(LineFilm& film, const Eigen::ArrayXd& roughness, double moes_film,
                             LineState& state, const Observer& observer) {
  LineFilm::Outcome outcome = solve_from_hertz(film, moes_film, state, observer);
  if (outcome.converged) return outcome;
  if (roughness.size() > 0) {
    const Eigen::ArrayXd rough = film.shape;
    film.shape = rough + roughness;
    outcome = outcome + solve_cold(film, {}, moes_film, state, observer);
    if (!outcome.converged) return outcome;
    const auto roughen = [&](double share) { film.shape = rough + (1 - share) * roughness; };
    return outcome + ramp(film, state, roughen, observer);
  }
  const material::Viscosity viscosity = film.lubricant.viscosity;
  if (!(material::pressure_coefficient(viscosity) > 0)) return outcome;
  film.lubricant.viscosity = with_share_of_coefficient(viscosity, 0);
  outcome = outcome + solve_from_hertz(film, moes_film, state, observer);
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

Eigen::ArrayXd line_asperity(const LineProblem& problem, double height, double width,
                             double place) {
  const Eigen::ArrayXd x = line_nodes(problem);
  check_length(problem, x, "width of an asperity", width);
  return x.unaryExpr([=](double at) {
    const double wave = std::cos(std::numbers::pi * (at - place) / width);
    return std::abs(at - place) < width / 2 ? height * wave * wave : 0.0;
  });
}

Eigen::ArrayXd line_waves(const LineProblem& problem, double amplitude, double wavelength) {
  const Eigen::ArrayXd x = line_nodes(problem);
  check_length(problem, x, "wavelength of a roughness", wavelength);
  return amplitude * (2 * std::numbers::pi / wavelength * x).sin();
}

Eigen::ArrayXd line_profile(const LineProblem& problem, const Eigen::ArrayXd& height,
                            double spacing) {
  const Eigen::ArrayXd x = line_nodes(problem);
  const double length = spacing * static_cast<double>(height.size() - 1);
  const double needed = x[x.size() - 1] - x[0];
  if (!(length >= needed)) {
    throw InputError("profile of a roughness", fmt::format("{:.4g} m long", length),
                     fmt::format("the domain of the film or more, {:.4g} m", needed),
                     "a longer profile, or a shorter grid.inlet and grid.outlet");
  }
  if (!height.isFinite().all()) {
    throw InputError("profile of a roughness", "holes", "none", "fill them first: tabor convert");
  }
  const Eigen::ArrayXd place = Eigen::ArrayXd::LinSpaced(height.size(), 0, length);
  const double middle = (length - needed) / 2 - x[0];
  Eigen::ArrayXd heights =
      x.unaryExpr([&](double at) { return interpolated(place, height, at + middle); });
  // Level what is used: a height or a slope of the profile would be taken for one of the cylinder.
  const Eigen::ArrayXd centred = x - x.mean();
  heights -= heights.mean();
  return heights - (heights * centred).sum() / centred.square().sum() * centred;
}

void measure_line(const LineProblem& problem, LineResult& result) {
  const double spacing = result.x[1] - result.x[0];
  result.min_film = smallest_film(result.film);
  result.central_film = interpolated(result.x, result.film, 0);
  result.max_pressure = result.pressure.maxCoeff();
  material::NodeLaws laws;
  const auto n = static_cast<std::size_t>(result.pressure.size());
  material::evaluate(problem.lubricant, {result.pressure.data(), n}, laws);
  result.friction_force = 0;
  for (Index i = 0; i < result.x.size(); ++i) {
    if (!(result.pressure[i] > 0)) continue;
    result.rupture = result.x[i];
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
  const LineFilm::Outcome outcome =
      solve_cold(film, problem.roughness, film_groups_of(problem).moes_min_film(), state, observer);
  LineResult result;
  result.x = film.x();
  result.pressure = state.pressure;
  result.film = state.film;
  result.separation = state.separation;
  result.newton_iterations = outcome.iterations;
  result.n_products = outcome.n_products;
  result.converged = outcome.converged;
  result.mass_error = outcome.mass_error;
  result.load_error = outcome.load_error;
  measure_line(problem, result);
  return result;
}

}  // namespace tabor::ehl
