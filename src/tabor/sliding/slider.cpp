#include "tabor/sliding/slider.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "tabor/core/error.hpp"
#include "tabor/core/loops.hpp"
#include "tabor/core/rows.hpp"
#include "tabor/core/units.hpp"

namespace tabor::sliding {
namespace {

constexpr double kLeastWork = 1e-3;  // of load and distance, in the step certificate

void check(const elastic::ElasticOperator& elasticity, const Problem& problem) {
  const Grid& grid = elasticity.grid();
  if (!std::isfinite(problem.saturation_pressure)) {
    throw InputError("sliding", "an elastic contact", "a saturation pressure",
                     "an elastic contact displaces nothing");
  }
  if (problem.sheet.rows() != grid.ny || problem.sheet.cols() != grid.nx ||
      problem.tool.rows() != grid.ny || problem.tool.cols() < 1) {
    throw InputError(
        "sliding",
        fmt::format("a sheet of {} x {} and a tool of {} x {} pixels", problem.sheet.cols(),
                    problem.sheet.rows(), problem.tool.cols(), problem.tool.rows()),
        fmt::format("{} x {} and as many rows of the tool", grid.nx, grid.ny), "");
  }
  if (!problem.tool.allFinite()) {
    throw InputError("sliding", "a tool with holes or infinite heights", "a height at every pixel",
                     "");
  }
  if (!(problem.reach > 0)) {
    throw InputError("reach", format_si(problem.reach, "m"), "more than zero", "");
  }
}

double mean_product(const Field& pressure, const Field& height) {
  return sum_over(pressure.size(), [&](Index i) { return pressure(i) * height(i); }) /
         static_cast<double>(pressure.size());
}

}  // namespace

Field tool_at(const Field& tool, Index place, Index n_columns) {
  const Index period = tool.cols();
  const Index first = ((place % period) + period) % period;
  Field height(tool.rows(), n_columns);
  for_each_pixel(tool.rows(), n_columns, [&](Index y, Index x) {
    height(y, x) = tool(y, (x - first + period * (1 + n_columns / period)) % period);
  });
  return height;
}

Ploughing& Ploughing::operator+=(const Ploughing& more) {
  distance += more.distance;
  work += more.work;
  lower += more.lower;
  upper += more.upper;
  moved += more.moved;
  lost += more.lost;
  without_space += more.without_space;
  return *this;
}

double Ploughing::friction(double of_work, double mean_pressure) const {
  if (!(distance > 0)) return std::numeric_limits<double>::quiet_NaN();
  return of_work / (mean_pressure * distance);
}

double Ploughing::certificate(double mean_pressure) const {
  if (!(distance > 0)) return std::numeric_limits<double>::quiet_NaN();
  return (upper - lower) / std::max(work, kLeastWork * mean_pressure * distance);
}

Slider::Slider(elastic::ElasticOperator& elasticity, Problem problem)
    : elasticity_(elasticity), problem_(std::move(problem)) {
  check(elasticity_, problem_);
}

void Slider::restore(const Slider& other) {
  problem_.sheet = other.problem_.sheet;
  problem_.place = other.problem_.place;
  state_ = other.state_;
  summary_ = other.summary_;
  energy_ = other.energy_;
}

Field Slider::pressed_height() const {
  return problem_.sheet + tool_at(problem_.tool, problem_.place, problem_.sheet.cols());
}

/// Takes what the contact has displaced off the sheet and puts it where it goes. Returns the
/// volumes.
Ploughing Slider::settle() {
  const Mask touching = contact::contact_mask(state_);
  Field depth(problem_.sheet.rows(), problem_.sheet.cols());
  for_each(depth.size(), [&](Index i) {
    const bool has_yielded = contact::at_cap(state_.pressure(i), problem_.saturation_pressure);
    depth(i) = has_yielded ? std::max(-state_.gap(i), 0.0) : 0.0;
  });
  const Raised raised =
      raise(problem_.displaced, depth, touching, state_.gap, elasticity_.grid(), problem_.reach);
  for_each(depth.size(), [&](Index i) { problem_.sheet(i) += raised.height(i) - depth(i); });
  const auto n = static_cast<double>(depth.size());
  const double moved = sum(depth) / n;
  return {.moved = moved, .lost = raised.lost / n, .without_space = raised.without_space / n};
}

Ploughing Slider::press(const Observer& observer) {
  const contact::Problem pressing{.height = pressed_height(),
                                  .control = contact::MeanPressure{problem_.mean_pressure},
                                  .bounds = {.upper = problem_.saturation_pressure},
                                  .tolerance = problem_.tolerance};
  state_ = contact::solve(elasticity_, pressing, contact::Solver::fast, observer);
  throw_if_stopped(state_.convergence);
  summary_ = contact::summarise(state_, pressing, elasticity_.grid(), elasticity_.drops_mean());
  energy_ = 0.5 * mean_product(state_.pressure, state_.displacement) +
            problem_.mean_pressure * state_.separation;
  return settle();
}

Ploughing Slider::advance(Index pixels, const Observer& observer) {
  const double energy_before = energy_;
  Field change = -tool_at(problem_.tool, problem_.place, problem_.sheet.cols());
  problem_.place += pixels;
  change += tool_at(problem_.tool, problem_.place, problem_.sheet.cols());
  const double lower = mean_product(state_.pressure, change);
  Ploughing step = press(observer);
  step.work = energy_ + problem_.saturation_pressure * step.moved - energy_before;
  step.lower = lower;
  step.upper = mean_product(state_.pressure, change);
  step.distance = static_cast<double>(pixels) * elasticity_.grid().dx();
  return step;
}

}  // namespace tabor::sliding
