#include "tabor/contact/load_problem.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "tabor/contact/conditions.hpp"
#include "tabor/contact/fast_solver.hpp"
#include "tabor/contact/polonsky_keer.hpp"
#include "tabor/core/large_pages.hpp"
#include "tabor/core/loops.hpp"
#include "tabor/numerics/field_statistics.hpp"

namespace tabor::contact {
namespace {

/// Mean square slope by forward differences, without wrapping around; 0 along an axis of one pixel.
double mean_square_slope(const Field& height, const Grid& grid) {
  const numerics::SquareSlopes slopes = numerics::mean_square_slopes(height, grid);
  const auto known = [](double value) { return std::isnan(value) ? 0 : value; };
  return known(slopes.along_x) + known(slopes.along_y);
}

/// True where the rms slope of a map is above a limit. On most surfaces its first rows show that.
bool is_steeper(const Field& height, const Grid& grid, double limit) {
  constexpr Index few = 64;
  if (grid.ny > 2 * few) {
    const Grid part{grid.nx, few, grid.lx, static_cast<double>(few) * grid.dy()};
    const double share = static_cast<double>(few - 1) / static_cast<double>(grid.ny);
    if (share * mean_square_slope(height.topRows(few), part) > limit * limit) return true;
  }
  return mean_square_slope(height, grid) > limit * limit;
}

/// True where full contact needs an rms pressure above a limit [Pa] to flatten the surface: E* / 2
/// * rms slope.
bool is_flattened_above(double limit, const elastic::ElasticOperator& elasticity,
                        const LoadProblem& problem) {
  return is_steeper(problem.height, elasticity.grid(), 2 * limit / elasticity.effective_modulus());
}

/// True where a pressure, and so much more [Pa], is above its cap somewhere.
bool exceeds(const Field& pressure, double more, const Caps& caps) {
  if (caps.are_one()) return more + extent_of(pressure).highest > caps.for_all();
  return count_where(pressure.size(), [&](Index i) { return more + pressure(i) > caps(i); }) > 0;
}

/// Takes p = P + S^-1 z, the answer if it stays within the bounds (contact everywhere); one
/// transform. Tried only where the pressure is not far below the flattening pressure.
bool try_full_contact(elastic::ElasticOperator& elasticity, const LoadProblem& problem,
                      State& state) {
  if (is_flattened_above(4 * problem.mean_pressure, elasticity, problem) ||
      !elasticity.apply_inverse(problem.height, state.pressure)) {
    return false;
  }
  state.convergence.fft_pairs += 1;
  state.pressure -= state.pressure.mean();
  if (problem.mean_pressure + state.pressure.minCoeff() < 0 ||
      exceeds(state.pressure, problem.mean_pressure, problem.caps)) {
    return false;
  }
  // The mean displaces nothing: left out, it costs the waves about it no digits.
  elasticity.apply(state.pressure, state.displacement);
  state.pressure += problem.mean_pressure;
  state.convergence.operator_applications = 1;
  state.convergence.fft_pairs += 1;
  state.convergence.tolerance = problem.tolerance;
  state.convergence.certificate = certificate_of(elasticity, problem, state);
  if (!(state.convergence.certificate <= problem.tolerance)) return false;
  state.convergence.status = Status::converged;
  return true;
}

State run(elastic::ElasticOperator& elasticity, const LoadProblem& problem, Solver solver,
          const Observer& observer) {
  return solver == Solver::fast ? solve_fast(elasticity, problem, observer)
                                : solve_polonsky_keer(elasticity, problem, observer);
}

/// Returns the state where the solver would have begun: all of a solution that was stopped before.
State stopped_at_start(elastic::ElasticOperator& elasticity, const LoadProblem& problem,
                       Solver solver) {
  LoadProblem start = problem;
  start.max_iterations = 0;
  State state = run(elasticity, start, solver, {});
  state.convergence.status = Status::stopped;
  return state;
}

/// True where so few contact pixels are at the cap that the error of the certificate may have put
/// them there.
bool cap_may_be_idle(const State& state, const Caps& caps) {
  constexpr double least_share = 0.005;  // of the contact pixels
  return static_cast<double>(saturated_mask(state, caps).count()) <=
         least_share * static_cast<double>(contact_mask(state).count());
}

/// A cap that no pressure reaches leaves the elastic answer, to the bit: wherever the cap turns out
/// idle, the answer is the one computed without it. Caps above what roughness usually reaches
/// are tried without first.
State run_capped(elastic::ElasticOperator& elasticity, const LoadProblem& problem, Solver solver,
                 const Observer& observer, bool& cap_is_idle) {
  double pairs_spent = 0;
  const auto try_elastic = [&](State& state) {
    LoadProblem elastic_problem = problem;
    elastic_problem.caps = kNoSaturation;
    state = run(elasticity, elastic_problem, solver, observer);
    pairs_spent += state.convergence.fft_pairs;
    cap_is_idle = !exceeds(state.pressure, 0, problem.caps);
    return cap_is_idle;
  };
  State state;
  const bool probably_idle =
      !is_flattened_above(0.1 * problem.caps.lowest(problem.height.size()), elasticity, problem);
  if (!probably_idle || !try_elastic(state)) {
    state = state.convergence.stopped() ? stopped_at_start(elasticity, problem, solver)
                                        : run(elasticity, problem, solver, observer);
    pairs_spent += state.convergence.fft_pairs;
    if (!probably_idle && state.convergence.converged() && cap_may_be_idle(state, problem.caps)) {
      State elastic_state;
      const bool is_idle = try_elastic(elastic_state);
      if (elastic_state.convergence.stopped()) state.convergence.status = Status::stopped;
      if (is_idle) state = std::move(elastic_state);
    }
  }
  state.convergence.fft_pairs = pairs_spent;
  return state;
}

}  // namespace

double certificate_of(const elastic::ElasticOperator& elasticity, const LoadProblem& problem,
                      const State& state) {
  const Field residual = state.displacement - problem.height;
  return Conditions(elasticity, problem)
      .certificate({{state.pressure.data(), state.pressure.data() + state.pressure.size()},
                    {residual.data(), residual.data() + residual.size()}},
                   problem.caps);
}

void finish_state(const elastic::ElasticOperator& elasticity, const LoadProblem& problem,
                  std::optional<double> given_separation, State& state) {
  const Conditions conditions(elasticity, problem);
  const Caps& caps = problem.caps;
  state.gap = uninitialised_map<Field>(state.pressure.rows(), state.pressure.cols());
  double* p = state.pressure.data();
  double* gap = state.gap.data();
  const auto n = static_cast<std::size_t>(state.gap.size());
  const double* displacement = state.displacement.data();
  const double* height = problem.height.data();
  for_each(n, [=](std::size_t i) { gap[i] = displacement[i] - height[i]; });
  const std::span<const double> pressures(p, n);
  const std::span<const double> residuals(gap, n);
  state.separation =
      given_separation ? *given_separation : conditions.separation(pressures, residuals, caps);
  state.gap_error = conditions.gap_error(pressures, residuals, caps, state.separation);
  state.gap_limit = conditions.gap_limit();
  const double separation = state.separation;
  for_each(n, [=](std::size_t i) {
    gap[i] += separation;
    if (!touches(p[i])) {
      gap[i] = std::max(gap[i], 0.0);
    } else if (at_cap(p[i], caps(i))) {
      p[i] = caps(i);
      gap[i] = std::min(gap[i], 0.0);
    } else {
      gap[i] = 0;
    }
  });
}

State solve_load(elastic::ElasticOperator& elasticity, LoadProblem problem, Solver solver,
                 const Observer& observer) {
  State state;
  bool cap_is_idle = !problem.caps.bound();
  if (asks_to_stop(observer, {"contact"})) {
    state = stopped_at_start(elasticity, problem, solver);
  } else if (!try_full_contact(elasticity, problem, state)) {
    const double pairs_spent = state.convergence.fft_pairs;
    state = cap_is_idle ? run(elasticity, problem, solver, observer)
                        : run_capped(elasticity, problem, solver, observer, cap_is_idle);
    state.convergence.fft_pairs += pairs_spent;
  }
  if (cap_is_idle) problem.caps = kNoSaturation;
  state.mean_pressure = problem.mean_pressure;
  finish_state(elasticity, problem, {}, state);
  return state;
}

}  // namespace tabor::contact
