#pragma once

#include <algorithm>

#include "tabor/core/convergence.hpp"

// Leads a solution from one value of a parameter to another in steps that adapt.
namespace tabor::numerics {

/// Steps of a continuation, as shares of the whole change of the parameter.
struct ContinuationSteps {
  double first = 0.5;
  double smallest = 1.0 / 64;  ///< steps this short are given up
  bool keeps_end = false;  ///< a try at share 1 that failed is where the next begins all the same
};

/// Leads `state`, a solution at share 0 of a change of a parameter, to share 1 by continuation:
/// each solution is the start of the next; steps grow where one is found and are halved where none
/// is. `solve(state, share)` advances a state to the solution at a share and returns its account,
/// with a member `convergence` and a sum that adds up the work. Returns the account of all steps;
/// stalled, with the last accepted solution in `state`, where steps became too short.
template <typename State, typename Solve>
auto follow(State& state, const ContinuationSteps& steps, Solve&& solve) {
  decltype(solve(state, 1.0)) outcome{};
  double share = 0;
  double step = steps.first;
  while (share < 1 && step > steps.smallest && !outcome.convergence.stopped()) {
    State next = state;
    const double aim = std::min(1.0, share + step);
    outcome = outcome + solve(next, aim);
    const bool is_found = outcome.convergence.converged();
    if (is_found) share = aim;
    if (is_found || (steps.keeps_end && aim >= 1)) state = next;
    step *= is_found ? 1.5 : 0.5;
  }
  if (outcome.convergence.failed()) outcome.convergence.status = Status::stalled;
  return outcome;
}

}  // namespace tabor::numerics
