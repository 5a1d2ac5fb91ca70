#include "tabor/contact/contact.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

#include "tabor/contact/images.hpp"
#include "tabor/contact/load_problem.hpp"
#include "tabor/contact/separation.hpp"
#include "tabor/core/error.hpp"
#include "tabor/core/loops.hpp"
#include "tabor/core/units.hpp"

namespace tabor::contact {
namespace {

void check_maps(const elastic::ElasticOperator& elasticity, const Problem& problem) {
  const Grid& grid = elasticity.grid();
  if (problem.height.rows() != grid.ny || problem.height.cols() != grid.nx) {
    throw InputError(
        "contact",
        fmt::format("heights of {} x {} pixels", problem.height.cols(), problem.height.rows()),
        fmt::format("{} x {} as the elastic operator", grid.nx, grid.ny), "");
  }
  if (problem.height.size() > kMostListed) {
    throw InputError("contact", fmt::format("{} x {} pixels", grid.nx, grid.ny),
                     "2^32 pixels at most", "");
  }
  if (!all_finite(problem.height)) {
    throw InputError("contact", "a surface with holes or infinite heights",
                     "a height at every pixel", "fill the holes first (<fill=harmonic>)");
  }
  const Field& caps = problem.bounds.upper_of_each;
  if (caps.size() > 0 && (caps.rows() != grid.ny || caps.cols() != grid.nx || !all_finite(caps) ||
                          !(extent_of(caps).lowest > 0))) {
    throw InputError("contact", "saturation pressures that are none on this grid",
                     "more than zero at every pixel of the heights", "");
  }
  if (problem.start.empty()) return;
  const std::vector<double>& start = problem.start.values();
  if (problem.start.rows() != grid.ny || problem.start.cols() != grid.nx ||
      !std::all_of(start.begin(), start.end(),
                   [](double p) { return p >= 0 && std::isfinite(p); })) {
    throw InputError("contact", "a pressure to start from that is no pressure on this grid",
                     "zero or more at every pixel of the heights", "");
  }
}

void check_load(const Problem& problem, double mean_pressure) {
  if (!(mean_pressure > 0) || !std::isfinite(mean_pressure)) {
    throw InputError("mean pressure", format_si(mean_pressure, "Pa"), "a positive pressure", "");
  }
  const double most = problem.bounds.caps().mean(problem.height.size());
  if (const auto* force = std::get_if<Force>(&problem.control); force && !(most > mean_pressure)) {
    throw InputError("<force>", format_si(force->value, "N"),
                     "less than " + format_si(most * force->value / mean_pressure, "N") +
                         ", under which all of the surface saturates",
                     "lower the force or raise the saturation pressure");
  }
  if (!(most > mean_pressure)) {
    throw InputError("saturation pressure", format_si(most, "Pa"),
                     "more than the mean pressure of " + format_si(mean_pressure, "Pa"),
                     "no pressure field below the cap can carry this load");
  }
}

void check(const elastic::ElasticOperator& elasticity, const Problem& problem) {
  check_maps(elasticity, problem);
  if (std::holds_alternative<Force>(problem.control) && elasticity.drops_mean()) {
    throw InputError("<force>", "a surface that repeats without end", "one that ends: a free patch",
                     "give a mean pressure");
  }
  if (const auto* separation = std::get_if<Separation>(&problem.control)) {
    require_reachable(elasticity, problem.height, problem.bounds, separation->value);
  } else {
    check_load(problem, prescribed_pressure(problem, elasticity.grid()));
  }
  if (!(problem.tolerance > 0)) {
    throw InputError("tolerance", fmt::format("{}", problem.tolerance),
                     "a positive number such as 1e-6", "");
  }
}

/// Returns what to take off heights before solving [m]: their highest where all lie farther from
/// zero than from each other, which would cost them digits; else nothing.
double offset_of(const Field& height) {
  const Extent extent = extent_of(height);
  return std::abs(extent.highest) > extent.highest - extent.lowest ? extent.highest : 0.0;
}

State solve_near_zero(elastic::ElasticOperator& elasticity, const Problem& problem, Solver solver,
                      const Observer& observer) {
  const LoadProblem under =
      under_pressure(problem, prescribed_pressure(problem, elasticity.grid()));
  const auto* separation = std::get_if<Separation>(&problem.control);
  return separation != nullptr
             ? solve_separation(elasticity, under, separation->value, solver, observer)
             : solve_load(elasticity, under, solver, observer);
}

/// Solves a checked problem wherever its heights lie.
State solve_map(elastic::ElasticOperator& elasticity, const Problem& problem, Solver solver,
                const Observer& observer) {
  const double offset = offset_of(problem.height);
  if (offset == 0) return solve_near_zero(elasticity, problem, solver, observer);
  Problem near_zero = problem;
  near_zero.height -= offset;
  if (auto* separation = std::get_if<Separation>(&near_zero.control)) separation->value -= offset;
  State state = solve_near_zero(elasticity, near_zero, solver, observer);
  state.separation += offset;
  return state;
}

}  // namespace

void require_reachable(const elastic::ElasticOperator& elasticity, const Field& height,
                       const Bounds& bounds, double separation) {
  const double highest = extent_of(height).highest;
  if (!(separation < highest)) {
    throw InputError("<separation>", format_si(separation, "m"),
                     "less than the highest point, at " + format_si(highest, "m"),
                     "the flat does not touch the surface there");
  }
  const double mean = sum(height) / static_cast<double>(height.size());
  const bool is_bounded = elasticity.drops_mean() && !bounds.caps().bound();
  constexpr double rounding = 1e-12;  // of the range of heights
  if (!std::isfinite(separation) ||
      (is_bounded && !(separation - mean > rounding * (highest - mean)))) {
    throw InputError("<separation>", format_si(separation, "m"),
                     "more than the mean height, " + format_si(mean, "m"),
                     "an elastic surface that repeats is flat there, under any higher pressure");
  }
}

double prescribed_pressure(const Problem& problem, const Grid& grid) {
  if (const auto* force = std::get_if<Force>(&problem.control)) return force->value / grid.area();
  const auto* mean_pressure = std::get_if<MeanPressure>(&problem.control);
  return mean_pressure != nullptr ? mean_pressure->value : std::numeric_limits<double>::quiet_NaN();
}

State solve(elastic::ElasticOperator& elasticity, const Problem& problem, Solver solver,
            const Observer& observer) {
  check(elasticity, problem);
  if (elastic::ElasticOperator* const of_image = elasticity.of_image()) {
    if (const auto image = problem_of_image(problem)) {
      return with_images(solve_map(*of_image, *image, solver, observer));
    }
  }
  return solve_map(elasticity, problem, solver, observer);
}

Field unloaded_height(const Field& height, const State& state) {
  return height + state.gap.min(0.0);
}

Mask contact_mask(const Field& pressure) {
  Mask mask(pressure.rows(), pressure.cols());
  for_each(mask.size(), [&](Index i) { mask(i) = touches(pressure(i)); });
  return mask;
}

Mask contact_mask(const State& state) { return contact_mask(state.pressure); }

Mask saturated_mask(const State& state, const Caps& saturation_pressure) {
  Mask saturated(state.pressure.rows(), state.pressure.cols());
  for_each(saturated.size(),
           [&](Index i) { saturated(i) = at_cap(state.pressure(i), saturation_pressure(i)); });
  return saturated;
}

}  // namespace tabor::contact
