#pragma once

#include "tabor/contact/contact.hpp"

// Defines the contact problem under a given mean pressure, to which solve() leads every control.
namespace tabor::contact {

/// Contact under a mean pressure: what the solvers solve. Refers to the maps of a Problem.
struct LoadProblem {
  const Field& height;         ///< [m]
  double mean_pressure;        ///< P [Pa]
  double saturation_pressure;  ///< p_sat [Pa]
  const Field& start;          ///< [Pa], empty: none
  double tolerance;
  int max_iterations;
};

/// Returns the problem under this mean pressure [Pa], which takes the place of the control.
inline LoadProblem under_pressure(const Problem& problem, double mean_pressure) {
  return {problem.height, mean_pressure,     problem.bounds.upper,
          problem.start,  problem.tolerance, problem.max_iterations};
}

}  // namespace tabor::contact
