#pragma once

#include <Eigen/Core>
#include <concepts>
#include <string_view>

#include "tabor/core/convergence.hpp"

// Solves nonlinear equations with an active set by Newton's method with damped steps.
namespace tabor::numerics {

/// Requirements of newton() on equations F(state) = 0 with an active set: at each node a bound or
/// an equation is in force, and the solution decides which.
///
///   state()              the unknowns and what follows from them; a value that can be copied back
///   step()               the solution of J step = -F at the state; empty if there is none
///   largest_share(step)  of a step, to begin with: 1, or less where a bound lies nearer
///   move(old, step, s)   sets the state a share s of the step away from `old`; false where that
///                        state is rejected
///   settle()             changes the set where the new state asks for it; true where the set is
///                        that before the step
///   measure()            sets the certificate; true where all equations in force hold
///   convergence()        the account of this solution; who counts products counts them there
template <typename T>
concept NewtonEquations = requires(T& equations, const Eigen::VectorXd& step) {
  { equations.step() } -> std::same_as<Eigen::VectorXd>;
  { equations.largest_share(step) } -> std::same_as<double>;
  { equations.move(equations.state(), step, 1.0) } -> std::same_as<bool>;
  { equations.settle() } -> std::same_as<bool>;
  { equations.measure() } -> std::same_as<bool>;
  { equations.convergence() } -> std::same_as<Convergence&>;
};

struct NewtonLimits {
  int max_iterations = 0;
  int max_halvings = 8;         ///< of a step
  std::string_view stage = {};  ///< name for the observer
};

/// Takes as much of a step as move() accepts: the largest share, or a half of it, a quarter and so
/// on. Returns false, and restores the state, if no share is accepted.
template <NewtonEquations Equations>
bool take(Equations& equations, const Eigen::VectorXd& step, int max_halvings) {
  if (step.size() == 0 || !step.allFinite()) return false;
  const auto old = equations.state();
  double share = equations.largest_share(step);
  for (int i = 0; i <= max_halvings; ++i, share /= 2) {
    if (equations.move(old, step, share)) return true;
  }
  equations.state() = old;
  return false;
}

/// Solves the equations by Newton's method with damped steps, semismooth through its active set
/// (Hintermueller, Ito & Kunisch 2002, doi:10.1137/S1052623401383558). Converged when a step leaves
/// the set as it was and all equations hold; stalled when no share of a step is accepted; not
/// converging is no error.
template <NewtonEquations Equations>
void newton(Equations& equations, const NewtonLimits& limits, const Observer& observer = {}) {
  Convergence& now = equations.convergence();
  if (asks_to_stop(observer, {.stage = limits.stage})) now.status = Status::stopped;
  while (now.status == Status::iteration_limit && now.iterations < limits.max_iterations) {
    ++now.iterations;
    if (!take(equations, equations.step(), limits.max_halvings)) {
      now.status = Status::stalled;
      break;
    }
    const bool is_settled = equations.settle();
    const bool holds = equations.measure();
    if (is_settled && holds) now.status = Status::converged;
    if (asks_to_stop(observer, {.stage = limits.stage, .convergence = &now})) {
      now.status = Status::stopped;
    }
  }
}

}  // namespace tabor::numerics
