#include "tabor/contact/contact.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include "tabor/contact/conditions.hpp"
#include "tabor/contact/fast_solver.hpp"
#include "tabor/contact/load_problem.hpp"
#include "tabor/contact/polonsky_keer.hpp"
#include "tabor/contact/scale.hpp"
#include "tabor/core/error.hpp"
#include "tabor/core/large_pages.hpp"
#include "tabor/core/loops.hpp"
#include "tabor/core/units.hpp"
#include "tabor/numerics/field_statistics.hpp"

namespace tabor::contact {
namespace {

bool all_finite(const Field& map) {
  const double n_finite = sum_over_blocks(
      map.size(), [](const auto& block) { return block.isFinite().count(); }, map.data());
  return n_finite == static_cast<double>(map.size());
}

void check_maps(const elastic::ElasticOperator& elasticity, const Problem& problem) {
  const Grid& grid = elasticity.grid();
  if (problem.height.rows() != grid.ny || problem.height.cols() != grid.nx) {
    throw InputError(
        "contact",
        fmt::format("heights of {} x {} pixels", problem.height.cols(), problem.height.rows()),
        fmt::format("{} x {} as the elastic operator", grid.nx, grid.ny), "");
  }
  if (!all_finite(problem.height)) {
    throw InputError("contact", "a surface with holes or infinite heights",
                     "a height at every pixel", "fill the holes first (--fill harmonic)");
  }
  if (problem.start.size() == 0) return;
  if (problem.start.rows() != grid.ny || problem.start.cols() != grid.nx ||
      !all_finite(problem.start) || extent_of(problem.start).lowest < 0) {
    throw InputError("contact", "a pressure to start from that is no pressure on this grid",
                     "zero or more at every pixel of the heights", "");
  }
}

void check(const elastic::ElasticOperator& elasticity, const Problem& problem) {
  check_maps(elasticity, problem);
  if (std::holds_alternative<Force>(problem.control) && elasticity.drops_mean()) {
    throw InputError("force", "a surface that repeats without end", "one that ends: a free patch",
                     "give a mean pressure");
  }
  const double mean_pressure = prescribed_pressure(problem, elasticity.grid());
  if (!(mean_pressure > 0) || !std::isfinite(mean_pressure)) {
    throw InputError("mean pressure", format_si(mean_pressure, "Pa"), "a positive pressure", "");
  }
  if (!(problem.bounds.upper > mean_pressure)) {
    throw InputError("saturation pressure", format_si(problem.bounds.upper, "Pa"),
                     "more than the mean pressure of " + format_si(mean_pressure, "Pa"),
                     "no pressure field below the cap can carry this load");
  }
  if (!(problem.tolerance > 0)) {
    throw InputError("tolerance", fmt::format("{}", problem.tolerance),
                     "a positive number such as 1e-6", "");
  }
}

/// Rms slope by forward differences, without wrapping around; 0 along an axis of one pixel.
double rms_slope(const Field& height, const Grid& grid) {
  const numerics::SquareSlopes slopes = numerics::mean_square_slopes(height, grid);
  const auto known = [](double value) { return std::isnan(value) ? 0 : value; };
  return std::sqrt(known(slopes.along_x) + known(slopes.along_y));
}

/// What to take off heights before solving [m]: their highest where all lie farther from zero than
/// from each other, which would cost them digits; else nothing.
double offset_of(const Field& height) {
  const Extent extent = extent_of(height);
  return std::abs(extent.highest) > extent.highest - extent.lowest ? extent.highest : 0.0;
}

/// Rms pressure [Pa] that full contact needs to flatten the surface: E* / 2 * rms slope.
double flattening_pressure(const elastic::ElasticOperator& elasticity, const LoadProblem& problem) {
  return 0.5 * elasticity.effective_modulus() * rms_slope(problem.height, elasticity.grid());
}

/// p = P + S^-1 z, the answer if it stays within the bounds (contact everywhere); one transform.
/// Tried only where the pressure is not far below the flattening pressure.
bool try_full_contact(elastic::ElasticOperator& elasticity, const LoadProblem& problem,
                      State& state) {
  if (problem.mean_pressure < 0.25 * flattening_pressure(elasticity, problem) ||
      !elasticity.apply_inverse(problem.height, state.pressure)) {
    return false;
  }
  state.convergence.fft_pairs += 1;
  state.pressure -= state.pressure.mean();
  if (problem.mean_pressure + state.pressure.minCoeff() < 0 ||
      problem.mean_pressure + state.pressure.maxCoeff() > problem.saturation_pressure) {
    return false;
  }
  // The mean displaces nothing: left out, it costs the waves about it no digits.
  elasticity.apply(state.pressure, state.displacement);
  state.pressure += problem.mean_pressure;
  state.convergence.operator_applications = 1;
  state.convergence.fft_pairs += 1;
  state.convergence.tolerance = problem.tolerance;
  const Field residual = state.displacement - problem.height;
  state.convergence.certificate =
      Conditions(elasticity, problem)
          .certificate({{state.pressure.data(), state.pressure.data() + state.pressure.size()},
                        {residual.data(), residual.data() + residual.size()}});
  if (!(state.convergence.certificate <= problem.tolerance)) return false;
  state.convergence.status = Status::converged;
  return true;
}

State run(elastic::ElasticOperator& elasticity, const LoadProblem& problem, Solver solver,
          const Observer& observer) {
  return solver == Solver::fast ? solve_fast(elasticity, problem, observer)
                                : solve_polonsky_keer(elasticity, problem, observer);
}

/// Where the solver would have begun: what is left of a solution that was stopped before.
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
bool cap_may_be_idle(const State& state, double cap) {
  constexpr double least_share = 0.005;  // of the contact pixels
  return static_cast<double>(saturated_mask(state, cap).count()) <=
         least_share * static_cast<double>(contact_mask(state).count());
}

/// A cap that no pressure reaches leaves the elastic answer, to the bit: wherever the cap turns out
/// idle, the answer is the one computed without it. Caps above what roughness usually reaches
/// are tried without first.
State run_capped(elastic::ElasticOperator& elasticity, const LoadProblem& problem, Solver solver,
                 const Observer& observer, bool& cap_is_idle) {
  const double cap = problem.saturation_pressure;
  double pairs_spent = 0;
  const auto try_elastic = [&](State& state) {
    LoadProblem elastic_problem = problem;
    elastic_problem.saturation_pressure = kNoSaturation;
    state = run(elasticity, elastic_problem, solver, observer);
    pairs_spent += state.convergence.fft_pairs;
    cap_is_idle = extent_of(state.pressure).highest <= cap;
    return cap_is_idle;
  };
  State state;
  const bool probably_idle = cap > 10 * flattening_pressure(elasticity, problem);
  if (!probably_idle || !try_elastic(state)) {
    state = state.convergence.stopped() ? stopped_at_start(elasticity, problem, solver)
                                        : run(elasticity, problem, solver, observer);
    pairs_spent += state.convergence.fft_pairs;
    if (!probably_idle && state.convergence.converged() && cap_may_be_idle(state, cap)) {
      State elastic_state;
      const bool is_idle = try_elastic(elastic_state);
      if (elastic_state.convergence.stopped()) state.convergence.status = Status::stopped;
      if (is_idle) state = std::move(elastic_state);
    }
  }
  state.convergence.fft_pairs = pairs_spent;
  return state;
}

/// Fixes the separation and makes pressure and gap exactly complementary, which moves either by no
/// more than the error that is reported: gap_error, and rounding of pressures at the cap.
void finish_state(const elastic::ElasticOperator& elasticity, const LoadProblem& problem,
                  State& state) {
  const Conditions conditions(elasticity, problem);
  const double cap = problem.saturation_pressure;
  state.gap = uninitialised_map<Field>(state.pressure.rows(), state.pressure.cols());
  double* p = state.pressure.data();
  double* gap = state.gap.data();
  const auto n = static_cast<std::size_t>(state.gap.size());
  const double* displacement = state.displacement.data();
  const double* height = problem.height.data();
  for_each(n, [=](std::size_t i) { gap[i] = displacement[i] - height[i]; });
  const std::span<const double> pressures(p, n);
  const std::span<const double> residuals(gap, n);
  state.separation = conditions.separation(pressures, residuals);
  state.gap_error = conditions.gap_error(pressures, residuals, state.separation);
  state.gap_limit = conditions.gap_limit();
  const double separation = state.separation;
  for_each(n, [=](std::size_t i) {
    gap[i] += separation;
    if (!touches(p[i])) {
      gap[i] = std::max(gap[i], 0.0);
    } else if (at_cap(p[i], cap)) {
      p[i] = cap;
      gap[i] = std::min(gap[i], 0.0);
    } else {
      gap[i] = 0;
    }
  });
}

/// Solves under a mean pressure, on heights that do not lie far from zero.
State solve_near_zero(elastic::ElasticOperator& elasticity, LoadProblem problem, Solver solver,
                      const Observer& observer) {
  State state;
  bool cap_is_idle = !std::isfinite(problem.saturation_pressure);
  if (asks_to_stop(observer, {"contact"})) {
    state = stopped_at_start(elasticity, problem, solver);
  } else if (!try_full_contact(elasticity, problem, state)) {
    const double pairs_spent = state.convergence.fft_pairs;
    state = cap_is_idle ? run(elasticity, problem, solver, observer)
                        : run_capped(elasticity, problem, solver, observer, cap_is_idle);
    state.convergence.fft_pairs += pairs_spent;
  }
  if (cap_is_idle) problem.saturation_pressure = kNoSaturation;
  state.mean_pressure = problem.mean_pressure;
  finish_state(elasticity, problem, state);
  return state;
}

}  // namespace

double prescribed_pressure(const Problem& problem, const Grid& grid) {
  if (const auto* force = std::get_if<Force>(&problem.control)) return force->value / grid.area();
  return std::get<MeanPressure>(problem.control).value;
}

State solve(elastic::ElasticOperator& elasticity, const Problem& problem, Solver solver,
            const Observer& observer) {
  check(elasticity, problem);
  const double mean_pressure = prescribed_pressure(problem, elasticity.grid());
  const double offset = offset_of(problem.height);
  if (offset == 0) {
    return solve_near_zero(elasticity, under_pressure(problem, mean_pressure), solver, observer);
  }
  Problem near_zero = problem;
  near_zero.height -= offset;
  State state =
      solve_near_zero(elasticity, under_pressure(near_zero, mean_pressure), solver, observer);
  state.separation += offset;
  return state;
}

Field unloaded_height(const Field& height, const State& state) {
  return height + state.gap.min(0.0);
}

Mask contact_mask(const Field& pressure) { return pressure.unaryExpr(&touches); }

Mask contact_mask(const State& state) { return contact_mask(state.pressure); }

Mask saturated_mask(const State& state, double saturation_pressure) {
  return state.pressure.unaryExpr(
      [=](double pressure) { return at_cap(pressure, saturation_pressure); });
}

}  // namespace tabor::contact
