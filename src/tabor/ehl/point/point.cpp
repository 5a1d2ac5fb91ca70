#include "tabor/ehl/point/point.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tabor/core/checks.hpp"
#include "tabor/core/error.hpp"
#include "tabor/ehl/plain.hpp"
#include "tabor/ehl/point/mixed.hpp"
#include "tabor/ehl/point/start.hpp"

namespace tabor::ehl {
namespace {

constexpr double kMinNodesPerHalfAxis = 4;
void check_domain(const PointProblem& problem) {
  if (problem.nodes_x < 3 || problem.nodes_y < 3) {
    throw InputError("nodes of a point contact",
                     fmt::format("{} x {}", problem.nodes_x, problem.nodes_y), "3 x 3 or more", "");
  }
  const double shortest = std::min({problem.inlet, problem.outlet, problem.half_width});
  if (!(shortest >= 1) || !std::isfinite(problem.inlet + problem.outlet + problem.half_width)) {
    throw InputError("domain of a point contact",
                     fmt::format("{:.4g} half axes beside the centre", shortest),
                     "1 or more: the contact of Hertz lies inside", "");
  }
  const reference::HertzEllipse hertz = hertz_of(problem);
  const Grid grid = point_grid(problem);
  const double film = film_groups_of(problem).nijenbanning_central();
  const double fewest =
      std::min((hertz.half_axis_x + std::sqrt(2 * problem.radius_x * film)) / grid.dx(),
               (hertz.half_axis_y + std::sqrt(2 * problem.radius_y * film)) / grid.dy());
  if (!(fewest >= kMinNodesPerHalfAxis)) {
    throw InputError("grid of a point contact",
                     fmt::format("{} x {} nodes, {:.3g} in the half axis of the pressed ellipse",
                                 problem.nodes_x, problem.nodes_y, fewest),
                     fmt::format("{} or more", kMinNodesPerHalfAxis),
                     "give more nodes or a smaller domain");
  }
  const Field& roughness = problem.roughness;
  if (roughness.size() == 0) return;
  if (roughness.rows() != problem.nodes_y || roughness.cols() != problem.nodes_x) {
    throw InputError("roughness", fmt::format("{} x {} values", roughness.rows(), roughness.cols()),
                     fmt::format("{} x {}, one per node", problem.nodes_y, problem.nodes_x), "");
  }
  if (!roughness.isFinite().all()) {
    throw InputError("roughness", "holes", "none", "fill them first: tabor convert");
  }
}

}  // namespace

reference::HertzEllipse hertz_of(const PointProblem& problem) {
  return reference::hertz_ellipse_at_load(problem.radius_x, problem.radius_y,
                                          problem.effective_modulus, problem.load);
}

reference::PointContactFilm film_groups_of(const PointProblem& problem) {
  return {.radius_x = problem.radius_x,
          .radius_y = problem.radius_y,
          .effective_modulus = problem.effective_modulus,
          .load = problem.load,
          .entrainment_speed = problem.entrainment_speed,
          .viscosity = material::ambient_viscosity(problem.lubricant.viscosity),
          .pressure_coefficient = material::pressure_coefficient(problem.lubricant.viscosity)};
}

Eigen::ArrayXd point_x(const PointProblem& problem) {
  const double half_axis = hertz_of(problem).half_axis_x;
  return Eigen::ArrayXd::LinSpaced(problem.nodes_x, -problem.inlet * half_axis,
                                   problem.outlet * half_axis);
}

Eigen::ArrayXd point_y(const PointProblem& problem) {
  const double half_axis = hertz_of(problem).half_axis_y;
  return Eigen::ArrayXd::LinSpaced(problem.nodes_y, -problem.half_width * half_axis,
                                   problem.half_width * half_axis);
}

Grid point_grid(const PointProblem& problem) {
  const reference::HertzEllipse hertz = hertz_of(problem);
  const auto nx = static_cast<double>(problem.nodes_x);
  const auto ny = static_cast<double>(problem.nodes_y);
  return {.nx = problem.nodes_x,
          .ny = problem.nodes_y,
          .lx = (problem.inlet + problem.outlet) * hertz.half_axis_x * nx / (nx - 1),
          .ly = 2 * problem.half_width * hertz.half_axis_y * ny / (ny - 1)};
}

void check_point(const PointProblem& problem) {
  check_positive("radius along the flow", problem.radius_x, "m");
  check_positive("radius across the flow", problem.radius_y, "m");
  check_positive("effective modulus", problem.effective_modulus, "Pa");
  check_positive("load", problem.load, "N");
  check_positive("entrainment speed", problem.entrainment_speed, "m/s");
  check_positive("boundary film", problem.asperities.boundary_film, "m");
  check(problem.asperities);
  check_positive("tolerance", problem.tolerance, "");
  check_positive("plastic pressure",
                 std::min(problem.plastic_pressure, std::numeric_limits<double>::max()), "Pa");
  if (!std::isfinite(problem.sliding_speed)) {
    throw InputError("sliding speed", fmt::format("{} m/s", problem.sliding_speed), "a number", "");
  }
  check_domain(problem);
  const reference::HertzEllipse hertz = hertz_of(problem);
  if (!(hertz.half_axis_x < problem.radius_x && hertz.half_axis_y < problem.radius_y)) {
    throw InputError("load of a point contact", fmt::format("{} N", problem.load),
                     "a contact narrower than its radii",
                     "the theory holds only for small deformations");
  }
  material::check_pressure(problem.lubricant, hertz.max_pressure);
}

PointResult solve_point_plainly(const PointProblem& problem) {
  check_point(problem);
  const PointFilm film(problem, {.coarsens = false});
  PointState state;
  const PointFilm::Outcome outcome = solve_cold(problem, film, state, {});
  return result_of(problem, film, state, outcome);
}

PointResult solve_point(const PointProblem& problem, const PointResult* start,
                        const Observer& observer) {
  check_point(problem);
  if (problem.roughness.size() > 0 || std::isfinite(problem.plastic_pressure)) {
    return solve_point_mixed(problem, start, observer);
  }
  const PointFilm film(problem);
  PointState state;
  PointFilm::Outcome outcome;
  if (start != nullptr) {
    state = state_of(film, *start);
    outcome = film.solve(state, film.conditions(), {}, observer);
  }
  if (outcome.convergence.failed()) outcome = outcome + solve_cold(problem, film, state, observer);
  PointResult smooth = result_of(problem, film, state, outcome);
  const bool is_found = smooth.convergence.converged();
  const bool is_open = smooth.film.minCoeff() >= problem.asperities.boundary_film;
  if (smooth.convergence.stopped() || (is_found && is_open)) return smooth;
  // A film this thin may also be why there is no solution without contact.
  PointResult mixed = solve_point_mixed(problem, is_found ? &smooth : start, observer);
  return is_found || !mixed.convergence.failed() ? mixed : smooth;
}

}  // namespace tabor::ehl
