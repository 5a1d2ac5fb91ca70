#include "tabor/sliding/slider.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "tabor/core/error.hpp"
#include "tabor/core/loops.hpp"
#include "tabor/core/resources.hpp"
#include "tabor/core/rows.hpp"
#include "tabor/core/units.hpp"

namespace tabor::sliding {
namespace {

constexpr double kLeastWork = 1e-3;  // of load and distance, in the step certificate

void check(const elastic::ElasticOperator& elasticity, const Problem& problem) {
  const Grid& grid = elasticity.grid();
  if (!std::isfinite(problem.saturation_pressure) && !(problem.wear_coefficient > 0)) {
    throw InputError("sliding", "an elastic contact that does not wear",
                     "a saturation pressure or a wear coefficient",
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
  if (!all_finite(problem.tool)) {
    throw InputError("sliding", "a tool with holes or infinite heights", "a height at every pixel",
                     "");
  }
  if (!(problem.hardening >= 0) || !std::isfinite(problem.hardening)) {
    throw InputError("hardening", fmt::format("{} Pa/m", problem.hardening), "zero or more", "");
  }
  if (problem.hardening > 0 && (!std::isfinite(problem.saturation_pressure) || problem.oil)) {
    throw InputError("hardening", problem.oil ? "trapped oil" : "an elastic sheet",
                     "a sheet that yields, without trapped oil", "");
  }
  if (!(problem.reach > 0)) {
    throw InputError("reach", format_si(problem.reach, "m"), "more than zero", "");
  }
}

/// What a contact was solved on: height = separation + displacement - gap [m].
Field solved_height(const contact::State& state) {
  return state.separation + state.displacement - state.gap;
}

double mean_product(const Field& pressure, const Field& height) {
  return sum_over(pressure.size(), [&](Index i) { return pressure(i) * height(i); }) /
         static_cast<double>(pressure.size());
}

/// Columns of a tool that repeats along x, over those of a sheet from its first on.
class ToolColumns {
 public:
  ToolColumns(Index period, Index place)
      : period_(period), column_((period - place % period) % period) {
    if (column_ < 0) column_ += period;
  }
  /// Returns the next one.
  Index next() {
    const Index column = column_;
    column_ = column + 1 == period_ ? 0 : column + 1;
    return column;
  }

 private:
  Index period_;
  Index column_;
};

/// Mean of a pressure times what moving the tool between two places changes [J/m^2].
double mean_product(const Field& pressure, const Field& tool, Index from, Index to) {
  const double all = sum_over_rows<1>(pressure.rows(), [&](Index y) {
    ToolColumns before(tool.cols(), from);
    ToolColumns after(tool.cols(), to);
    double row = 0;
    for (Index x = 0; x < pressure.cols(); ++x) {
      row += pressure(y, x) * (tool(y, after.next()) - tool(y, before.next()));
    }
    return Eigen::Array<double, 1, 1>(row);
  })(0);
  return all / static_cast<double>(pressure.size());
}

}  // namespace

Field tool_at(const Field& tool, Index place, Index n_columns) {
  Field height(tool.rows(), n_columns);
  for_each_row(tool.rows(), [&](Index y) {
    ToolColumns columns(tool.cols(), place);
    for (Index x = 0; x < n_columns; ++x) height(y, x) = tool(y, columns.next());
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
  worn += more.worn;
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

Slider::Reached Slider::reached() const {
  return {.sheet = problem_.sheet,
          .pressure = state_.pressure,
          .with_oil = trapped_ ? trapped_->contact.pressure : Field(),
          .caps = next_caps(),
          .energy = energy_,
          .place = problem_.place};
}

void Slider::go_on_from(Reached reached) {
  problem_.sheet = std::move(reached.sheet);
  problem_.place = reached.place;
  trapped_.reset();
  if (reached.with_oil.size() > 0) {
    trapped_.emplace().contact.pressure = std::move(reached.with_oil);
  }
  state_ = {};
  state_.pressure = std::move(reached.pressure);
  caps_ = std::move(reached.caps);
  energy_ = reached.energy;
}

Mask Slider::touching() const {
  return trapped_ ? contact::solid_contact(*trapped_) : contact::contact_mask(state_);
}

/// Height of sheet and tool, moved by so many pixels [m].
Field Slider::pressed_height(Index pixels) const {
  Field height = tool_at(problem_.tool, problem_.place + pixels, problem_.sheet.cols());
  for_each(height.size(), [&](Index i) { height(i) += problem_.sheet(i); });
  return height;
}

/// Takes off what the solids wear over a distance [m]; returns the volume [m].
double Slider::wear(double distance) {
  if (!(problem_.wear_coefficient > 0)) return 0;
  const Mask solid = touching();
  const Field& pressure = displacing().pressure;
  const double depth = problem_.wear_coefficient * distance;  // under 1 Pa [m]
  const auto worn = [&](Index i) { return solid(i) ? depth * pressure(i) : 0.0; };
  for_each(pressure.size(), [&](Index i) { problem_.sheet(i) -= worn(i); });
  const auto n = static_cast<double>(pressure.size());
  energy_ -= sum_over(pressure.size(), [&](Index i) { return pressure(i) * worn(i); }) / n;
  return sum_over(pressure.size(), worn) / n;
}

contact::Caps Slider::caps() const {
  return caps_.size() > 0 ? contact::Caps(caps_.data())
                          : contact::Caps(problem_.saturation_pressure);
}

/// Saturation pressures after what the last contact displaced [Pa]; none without hardening.
Field Slider::next_caps() const {
  const contact::State& pressed = displacing();
  if (!(problem_.hardening > 0) || pressed.gap.size() == 0) return caps_;
  Field hardened(pressed.gap.rows(), pressed.gap.cols());
  const contact::Caps before = caps();
  for_each(hardened.size(),
           [&](Index i) { hardened(i) = before(i) + problem_.hardening * yielded(pressed, i); });
  return hardened;
}

/// How deep a pixel of the last contact has yielded [m].
double Slider::yielded(const contact::State& pressed, Index i) const {
  return contact::at_cap(pressed.pressure(i), caps()(i)) ? std::max(-pressed.gap(i), 0.0) : 0.0;
}

/// Takes what the contact has displaced off the sheet and puts it where it goes. Returns the
/// volumes.
Ploughing Slider::settle() {
  const contact::State& pressed = displacing();
  Field depth(problem_.sheet.rows(), problem_.sheet.cols());
  for_each(depth.size(), [&](Index i) { depth(i) = yielded(pressed, i); });
  const Raised raised = raise(problem_.displaced, std::move(depth), touching(), pressed.gap,
                              elasticity_.grid(), problem_.reach);
  for_each(problem_.sheet.size(),
           [&](Index i) { problem_.sheet(i) += raised.height(i) - yielded(pressed, i); });
  const auto n = static_cast<double>(problem_.sheet.size());
  const double moved = raised.volume / n;
  yielding_ = problem_.saturation_pressure * moved;
  if (caps_.size() > 0) {
    yielding_ = sum_over(caps_.size(), [&](Index i) { return caps_(i) * yielded(pressed, i); }) / n;
  }
  return {.moved = moved, .lost = raised.lost / n, .without_space = raised.without_space / n};
}

Ploughing Slider::press(const Observer& observer) { return press(0, observer); }

contact::Problem Slider::pressing(Field height) const {
  return {.height = std::move(height),
          .control = contact::MeanPressure{problem_.mean_pressure},
          .bounds = {.upper = problem_.saturation_pressure, .upper_of_each = caps_},
          .tolerance = problem_.tolerance};
}

/// Moves the tool and presses it, from the pressure of the contact before: the bearing area of its
/// gap, and a coarse solution, are farther off. The place is the new one only when the contact is
/// solved, so that a stopped step can be taken again.
Ploughing Slider::press(Index pixels, const Observer& observer) {
  caps_ = next_caps();
  contact::Problem problem = pressing(pressed_height(pixels));
  problem.start = state_.pressure;
  for (Field* map : {&state_.pressure, &state_.displacement, &state_.gap}) map->resize(0, 0);
  contact::State dry = contact::solve(elasticity_, problem, contact::Solver::fast, observer);
  if (dry.convergence.stopped()) state_.pressure = problem.start.map();
  throw_if_stopped(dry.convergence);
  if (problem_.oil) {
    const contact::GapLiquid liquid{.film = problem_.oil->film,
                                    .bulk_modulus = problem_.oil->bulk_modulus,
                                    .periodic = problem_.oil->periodic};
    contact::TrappedState trapped =
        contact::solve_trapped(elasticity_, problem, liquid, dry, observer);
    if (trapped.contact.convergence.stopped()) state_.pressure = problem.start.map();
    throw_if_stopped(trapped.contact.convergence);
    trapped_ = std::move(trapped);
  }
  state_ = std::move(dry);
  problem_.place += pixels;
  energy_ = 0.5 * mean_product(state_.pressure, state_.displacement) +
            problem_.mean_pressure * state_.separation;
  problem = {};  // memory for what follows
  elasticity_.free_memory();
  return_freed_memory();
  return settle();
}

Ploughing Slider::advance(Index pixels, const Observer& observer) {
  const double energy_before = energy_;
  const Index from = problem_.place;
  const double lower = mean_product(last_pressure(), problem_.tool, from, from + pixels);
  Ploughing step = press(pixels, observer);
  step.lower = lower;
  step.upper = mean_product(last_pressure(), problem_.tool, from, from + pixels);
  step.work = energy_ - energy_before;
  if (step.moved > 0) step.work += yielding_;
  if (problem_.oil) step.work = 0.5 * (step.lower + step.upper);
  step.distance = static_cast<double>(pixels) * elasticity_.grid().dx();
  step.worn = wear(step.distance);
  return step;
}

contact::Summary Slider::summary() const {
  return contact::summarise(state_, pressing(solved_height(state_)), elasticity_.grid(),
                            elasticity_.drops_mean());
}

contact::Summary Slider::summary_of_solids() {
  return contact::summarise_solids(*trapped_, pressing(solved_height(trapped_->contact)),
                                   elasticity_.grid(), elasticity_.drops_mean());
}

}  // namespace tabor::sliding
