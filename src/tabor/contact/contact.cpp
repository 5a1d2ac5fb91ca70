#include "tabor/contact/contact.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "tabor/contact/certificate.hpp"
#include "tabor/contact/fast_solver.hpp"
#include "tabor/contact/polonsky_keer.hpp"
#include "tabor/contact/scale.hpp"
#include "tabor/core/error.hpp"
#include "tabor/core/parallel.hpp"
#include "tabor/core/units.hpp"

namespace tabor::contact {
namespace {

void check(const elastic::ElasticOperator& elasticity, const Problem& problem) {
  const Grid& grid = elasticity.grid();
  if (problem.height.rows() != grid.ny || problem.height.cols() != grid.nx) {
    throw InputError(
        "contact",
        fmt::format("heights of {} x {} pixels", problem.height.cols(), problem.height.rows()),
        fmt::format("{} x {} as the elastic operator", grid.nx, grid.ny), "");
  }
  if (!problem.height.isFinite().all()) {
    throw InputError("contact", "a surface with holes or infinite heights",
                     "a height at every pixel", "fill the holes first (--fill harmonic)");
  }
  if (!(problem.mean_pressure > 0) || !std::isfinite(problem.mean_pressure)) {
    throw InputError("mean pressure", format_si(problem.mean_pressure, "Pa"), "a positive pressure",
                     "");
  }
  if (!(problem.saturation_pressure > problem.mean_pressure)) {
    throw InputError("saturation pressure", format_si(problem.saturation_pressure, "Pa"),
                     "more than the mean pressure of " + format_si(problem.mean_pressure, "Pa"),
                     "no pressure field below the cap can carry this load");
  }
  if (!(problem.tolerance > 0)) {
    throw InputError("tolerance", fmt::format("{}", problem.tolerance),
                     "a positive number such as 1e-6", "");
  }
}

/// Rms slope by forward differences, without wrapping around.
double rms_slope(const Field& height, const Grid& grid) {
  const auto mean_square = [](const auto& difference, double spacing) {
    return difference.size() == 0 ? 0.0 : difference.square().mean() / (spacing * spacing);
  };
  const Index nx = grid.nx;
  const Index ny = grid.ny;
  return std::sqrt(mean_square(height.rightCols(nx - 1) - height.leftCols(nx - 1), grid.dx()) +
                   mean_square(height.bottomRows(ny - 1) - height.topRows(ny - 1), grid.dy()));
}

/// Rms pressure [Pa] that full contact needs to flatten the surface: E* / 2 * rms slope.
double flattening_pressure(const elastic::ElasticOperator& elasticity, const Problem& problem) {
  return 0.5 * elasticity.effective_modulus() * rms_slope(problem.height, elasticity.grid());
}

/// p = P + S^-1 z, the answer if it stays within the bounds (contact everywhere); one transform.
/// Tried only where the pressure is not far below the flattening pressure.
bool try_full_contact(elastic::ElasticOperator& elasticity, const Problem& problem, State& state) {
  if (problem.mean_pressure < 0.25 * flattening_pressure(elasticity, problem) ||
      !elasticity.apply_inverse(problem.height, state.pressure)) {
    return false;
  }
  state.convergence.fft_pairs += 1;
  state.pressure += problem.mean_pressure - state.pressure.mean();
  if (state.pressure.minCoeff() < 0 || state.pressure.maxCoeff() > problem.saturation_pressure) {
    return false;
  }
  elasticity.apply(state.pressure, state.displacement);
  state.convergence.operator_applications = 1;
  state.convergence.fft_pairs += 1;
  state.convergence.tolerance = problem.tolerance;
  const Field residual = state.displacement - problem.height;
  const Candidates all{
      std::vector<double>(state.pressure.data(), state.pressure.data() + state.pressure.size()),
      std::vector<double>(residual.data(), residual.data() + residual.size())};
  const double load = problem.mean_pressure * static_cast<double>(residual.size());
  state.convergence.certificate =
      std::max(0.0, duality_gap(all, load, problem.saturation_pressure)) /
      (load * length_scale(elasticity, problem));
  state.convergence.converged = state.convergence.certificate <= problem.tolerance;
  return state.convergence.converged;
}

State run(elastic::ElasticOperator& elasticity, const Problem& problem, Solver solver,
          const Observer& observer) {
  return solver == Solver::fast ? solve_fast(elasticity, problem, observer)
                                : solve_polonsky_keer(elasticity, problem, observer);
}

/// True where so few contact pixels are at the cap that the error of the certificate may have put
/// them there.
bool cap_may_be_idle(const State& state, double cap) {
  constexpr double least_share = 0.005;  // of the contact pixels
  return static_cast<double>((state.pressure >= cap).count()) <=
         least_share * static_cast<double>((state.pressure > 0).count());
}

/// A cap that no pressure reaches leaves the elastic answer, to the bit: wherever the cap turns out
/// idle, the answer is the one computed without it. Caps above what roughness usually reaches
/// are tried without first.
State run_capped(elastic::ElasticOperator& elasticity, const Problem& problem, Solver solver,
                 const Observer& observer, bool& cap_is_idle) {
  const double cap = problem.saturation_pressure;
  double pairs_spent = 0;
  const auto try_elastic = [&](State& state) {
    Problem elastic_problem = problem;
    elastic_problem.saturation_pressure = kNoSaturation;
    state = run(elasticity, elastic_problem, solver, observer);
    pairs_spent += state.convergence.fft_pairs;
    cap_is_idle = state.pressure.maxCoeff() <= cap;
    return cap_is_idle;
  };
  State state;
  const bool probably_idle = cap > 10 * flattening_pressure(elasticity, problem);
  if (!probably_idle || !try_elastic(state)) {
    state = run(elasticity, problem, solver, observer);
    pairs_spent += state.convergence.fft_pairs;
    State elastic_state;
    if (!probably_idle && state.convergence.converged && cap_may_be_idle(state, cap) &&
        try_elastic(elastic_state)) {
      state = std::move(elastic_state);
    }
  }
  state.convergence.fft_pairs = pairs_spent;
  return state;
}

/// Separation: contact pixels below saturation have zero mean gap; if all are saturated, the
/// largest overlap-free level. The gap is then set exactly complementary to the pressure, which
/// moves it by no more than the certificate's error.
void finish_state(const Problem& problem, double cap, State& state) {
  double total = 0;
  double n_free = 0;
  double saturated_level = -std::numeric_limits<double>::infinity();
  for (Index i = 0; i < state.pressure.size(); ++i) {
    const double p = state.pressure(i);
    const double residual = state.displacement(i) - problem.height(i);
    if (p > 0 && p < cap) {
      total += residual;
      n_free += 1;
    } else if (p >= cap) {
      saturated_level = std::max(saturated_level, residual);
    }
  }
  state.separation = -(n_free > 0 ? total / n_free : saturated_level);
  state.gap.resizeLike(state.pressure);
  parallel_for(state.gap.size(), kBlock, [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i) {
      const double gap = state.separation + state.displacement(i) - problem.height(i);
      const double p = state.pressure(i);
      state.gap(i) = p <= 0 ? std::max(gap, 0.0) : (p < cap ? 0.0 : std::min(gap, 0.0));
    }
  });
}

}  // namespace

State solve(elastic::ElasticOperator& elasticity, const Problem& problem, Solver solver,
            const Observer& observer) {
  check(elasticity, problem);
  State state;
  bool cap_is_idle = !std::isfinite(problem.saturation_pressure);
  if (!try_full_contact(elasticity, problem, state)) {
    const double pairs_spent = state.convergence.fft_pairs;
    state = cap_is_idle ? run(elasticity, problem, solver, observer)
                        : run_capped(elasticity, problem, solver, observer, cap_is_idle);
    state.convergence.fft_pairs += pairs_spent;
  }
  finish_state(problem, cap_is_idle ? kNoSaturation : problem.saturation_pressure, state);
  return state;
}

Field unloaded_height(const Field& height, const State& state) {
  return height + state.gap.min(0.0);
}

Mask contact_mask(const State& state) { return state.pressure > 0; }

}  // namespace tabor::contact
