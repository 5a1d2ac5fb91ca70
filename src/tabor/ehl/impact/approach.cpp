#include "tabor/ehl/impact/approach.hpp"

#include <cmath>

#include "tabor/reference/hertz.hpp"
#include "tabor/reference/squeeze.hpp"

namespace tabor::ehl {

namespace {

reference::SphereSqueeze rigid_ball(const ImpactProblem& problem) {
  return {.radius = problem.radius,
          .viscosity = material::ambient_viscosity(problem.lubricant.viscosity),
          .wetted_gap = problem.layer};
}

constexpr double kStep = 2e-3;           // of h0, relative
constexpr double kDeformedShare = 0.01;  // of h0: where the bodies stop being rigid
constexpr double kStopped = 1e-6;        // of the speed of approach

struct Slope {
  double speed = 0;  // dv/dh0 [1/s]
  double time = 0;   // dt/dh0 [s/m]
};

Slope slope(const ImpactProblem& problem, double separation, double speed) {
  const double acceleration =
      rigid_squeeze_force(problem, separation, speed) / problem.mass - problem.gravity;
  return {acceleration / speed, 1 / speed};
}

/// One step of the classical fourth-order Runge-Kutta method down to `separation`.
Approach descend(const ImpactProblem& problem, const Approach& from, double separation) {
  const double step = separation - from.separation;
  const double middle = from.separation + step / 2;
  const Slope a = slope(problem, from.separation, from.speed);
  const Slope b = slope(problem, middle, from.speed + step / 2 * a.speed);
  const Slope c = slope(problem, middle, from.speed + step / 2 * b.speed);
  const Slope d = slope(problem, separation, from.speed + step * c.speed);
  Approach to;
  to.separation = separation;
  to.speed = from.speed + step / 6 * (a.speed + 2 * b.speed + 2 * c.speed + d.speed);
  to.time = from.time + step / 6 * (a.time + 2 * b.time + 2 * c.time + d.time);
  to.force = rigid_squeeze_force(problem, to.separation, to.speed);
  return to;
}

bool is_deformed(const ImpactProblem& problem, const Approach& at) {
  const double deformation =
      reference::hertz_at_load(problem.radius, problem.effective_modulus, at.force).approach;
  return deformation >= kDeformedShare * at.separation;
}

}  // namespace

double rigid_squeeze_force(const ImpactProblem& problem, double separation, double speed) {
  return rigid_ball(problem).force(separation, -speed);
}

double rigid_squeeze_pressure(const ImpactProblem& problem, double separation, double speed,
                              double r) {
  const double film = separation + r * r / (2 * problem.radius);
  return film < problem.layer ? rigid_ball(problem).pressure(film, -speed) : 0;
}

std::vector<Approach> rigid_approach(const ImpactProblem& problem) {
  std::vector<Approach> path = {{.separation = problem.layer, .speed = -problem.speed}};
  while (!is_deformed(problem, path.back())) {
    const Approach next = descend(problem, path.back(), path.back().separation * (1 - kStep));
    if (!(next.speed < -kStopped * problem.speed)) {
      path.back().speed = 0;
      return path;
    }
    path.push_back(next);
  }
  return path;
}

}  // namespace tabor::ehl
