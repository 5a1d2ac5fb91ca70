#pragma once

#include <optional>

#include "tabor/contact/caps.hpp"
#include "tabor/contact/contact.hpp"

// Defines and solves the contact under a given mean pressure, to which solve() leads every control.
namespace tabor::contact {

/// Contact under a mean pressure: what the solvers solve. Refers to the maps of a Problem.
struct LoadProblem {
  const Field& height;        ///< [m]
  double mean_pressure;       ///< P [Pa]
  Caps caps;                  ///< p_sat [Pa]
  const PressureList& start;  ///< empty: none
  double tolerance;
  int max_iterations;
};

/// Returns the problem under this mean pressure [Pa], which takes the place of the control.
inline LoadProblem under_pressure(const Problem& problem, double mean_pressure) {
  return {problem.height, mean_pressure,     problem.bounds.caps(),
          problem.start,  problem.tolerance, problem.max_iterations};
}

/// Solves under the mean pressure, on heights that do not lie far from zero. Not reaching the
/// tolerance is returned, and so is being stopped.
State solve_load(elastic::ElasticOperator& elasticity, LoadProblem problem, Solver solver,
                 const Observer& observer);

/// Returns the certificate of the pressure and displacement of a state.
double certificate_of(const elastic::ElasticOperator& elasticity, const LoadProblem& problem,
                      const State& state);

/// Fixes the separation, unless it is given, and makes pressure and gap exactly complementary,
/// which moves either by no more than the error that is reported: gap_error, and rounding of
/// pressures at the cap.
void finish_state(const elastic::ElasticOperator& elasticity, const LoadProblem& problem,
                  std::optional<double> given_separation, State& state);

}  // namespace tabor::contact
