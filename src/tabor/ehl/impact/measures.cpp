#include "tabor/ehl/impact/measures.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace tabor::ehl {

namespace {

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
constexpr double kNoForce = 1e-4;  // of the maximum: the end of the impact
constexpr double kAtTheEnd = 0.5;  // of the maximum: a pressure peak under less force is the spike

using History = std::vector<ImpactInstant>;
using Value = double ImpactInstant::*;

struct Extremum {
  double time = kNothing;
  double value = kNothing;
  std::size_t index = 0;
};

/// The vertex of the parabola through the instants i - 1, i, i + 1.
Extremum vertex(const History& history, Value value, std::size_t i) {
  const Extremum plain{history[i].time, history[i].*value, i};
  if (i == 0 || i + 1 >= history.size()) return plain;
  const ImpactInstant& a = history[i - 1];
  const ImpactInstant& b = history[i];
  const ImpactInstant& c = history[i + 1];
  const double left = (b.*value - a.*value) / (b.time - a.time);
  const double right = (c.*value - b.*value) / (c.time - b.time);
  const double curvature = (right - left) / (c.time - a.time);
  if (curvature == 0) return plain;
  const double away = (a.time - b.time) / 2 - left / (2 * curvature);  // from b to the vertex
  const double slope = left + curvature * (b.time - a.time);           // at b
  return {b.time + away, b.*value + slope * away + curvature * away * away, i};
}

template <typename Before>
Extremum extremum(const History& history, Value value, Before before) {
  const auto place = std::max_element(
      history.begin(), history.end(),
      [&](const ImpactInstant& a, const ImpactInstant& b) { return before(a.*value, b.*value); });
  return vertex(history, value, static_cast<std::size_t>(place - history.begin()));
}

Extremum maximum(const History& history, Value value) {
  return extremum(history, value, std::less<>());
}

Extremum minimum(const History& history, Value value) {
  return extremum(history, value, std::greater<>());
}

/// First time after instant `from` at which the values pass `level`.
double crossing(const History& history, Value value, double level, std::size_t from) {
  for (std::size_t i = from + 1; i < history.size(); ++i) {
    const double before = history[i - 1].*value;
    const double after = history[i].*value;
    if ((before - level) * (after - level) > 0 || before == after) continue;
    const double share = (level - before) / (after - before);
    return history[i - 1].time + share * (history[i].time - history[i - 1].time);
  }
  return kNothing;
}

/// The first peak of the pressure in the centre, unless it is the spike under a film that carries
/// hardly anything any more.
Extremum primary_peak(const History& history, double max_force) {
  for (std::size_t i = 1; i + 1 < history.size(); ++i) {
    const double pressure = history[i].central_pressure;
    const bool is_peak =
        pressure > history[i - 1].central_pressure && pressure >= history[i + 1].central_pressure;
    if (is_peak && history[i].force > kAtTheEnd * max_force) {
      return vertex(history, &ImpactInstant::central_pressure, i);
    }
  }
  return {};
}

/// The first instant after the film filled the domain at which its edge carries nothing.
double shrinking_since(const ImpactResult& result) {
  // The outermost ring ends half a cell before the edge.
  const Index n = result.radius.size();
  if (n < 2) return kNothing;
  const double whole = (result.radius[n - 1] + result.radius[n - 2]) / 2 * (1 - 1e-9);
  for (std::size_t i = 1; i < result.history.size(); ++i) {
    if (result.history[i].time <= result.full_start_time) continue;
    if (result.history[i - 1].film_radius >= whole && result.history[i].film_radius < whole) {
      return result.history[i].time;
    }
  }
  return kNothing;
}

}  // namespace

double highest_pressure(const ImpactResult& result) {
  return maximum(result.history, &ImpactInstant::max_pressure).value;
}

void measure(const ImpactProblem& problem, ImpactResult& result) {
  const History& history = result.history;
  const Extremum force = maximum(history, &ImpactInstant::force);
  const Extremum film = minimum(history, &ImpactInstant::min_film);
  const Extremum peak = primary_peak(history, force.value);
  result.max_force = force.value;
  result.time_max_force = force.time;
  result.min_film = film.value;
  result.time_min_film = film.time;
  result.max_deformation = maximum(history, &ImpactInstant::deformation).value;
  result.primary_pressure = peak.value;
  result.time_primary_pressure = peak.time;
  result.turning_time = crossing(history, &ImpactInstant::speed, 0, 0);
  result.impact_time =
      crossing(history, &ImpactInstant::force, kNoForce * force.value, force.index);
  result.cavitation_time = shrinking_since(result);
  const double rebound = result.end == ImpactEnd::rebound ? history.back().speed : 0.0;
  result.rebound_speed = result.convergence.converged() ? rebound : kNothing;
  result.restitution = result.rebound_speed / problem.speed;
}

ImpactGroups groups_of(const ImpactProblem& problem, const ImpactResult& result) {
  const double e_prime = 2 * problem.effective_modulus;
  const double radius = problem.radius;
  const double viscosity = material::ambient_viscosity(problem.lubricant.viscosity);
  ImpactGroups groups;
  groups.layer = problem.layer / radius;
  groups.speed = viscosity * problem.speed / (e_prime * radius);
  groups.mass = problem.mass * e_prime / (radius * viscosity * viscosity);
  groups.material = material::pressure_coefficient(problem.lubricant.viscosity) * e_prime;
  groups.force = result.max_force / (e_prime * radius * radius);
  groups.primary_pressure = result.primary_pressure / e_prime;
  groups.min_film = result.min_film / radius;
  groups.delay =
      (result.time_min_film - result.time_max_force) / (result.impact_time - result.time_max_force);
  return groups;
}

}  // namespace tabor::ehl
