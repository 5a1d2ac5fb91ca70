#pragma once

#include <functional>
#include <vector>

#include "tabor/ehl/point/point.hpp"

// Follows the film of a point contact under a roughness that moves.
namespace tabor::ehl {

/// A rough surface that moves through a point contact, under a constant load. Solids must not
/// touch: a film that would close ends the history.
struct TransientPointProblem {
  PointProblem contact;  ///< without roughness or a cap on the pressure
  /// s [m] at the nodes at a time t [s], asperities up, shape (nodes_y, nodes_x).
  std::function<Field(double time)> roughness;
  double time_step = 0;  ///< [s]; a cell is passed in dx/u_m
  int steps = 0;
};

/// The contact at one time.
struct PointMoment {
  double time = 0;          ///< [s]
  double central_film = 0;  ///< [m] at the node next to (0, 0)
  double min_film = 0;      ///< [m]
  double max_pressure = 0;  ///< [Pa]
};

struct TransientPointResult {
  std::vector<PointMoment> history;  ///< from t = 0 on, one at least
  PointResult last;                  ///< fields at the last time that was reached
  Convergence convergence;           ///< of all steps; certificate: of the last one
};

/// From the steady film at roughness(0), by implicit Euler steps of the squeeze term d(rho h)/dt
/// (first order in time), each by PointFilm::solve(). Throws InputError as solve_point() does, and
/// for a step that is not positive, no roughness, or one of another shape. Not converging is
/// returned, and so is being stopped.
TransientPointResult solve_point_transient(const TransientPointProblem& problem,
                                           const Observer& observer = {});

}  // namespace tabor::ehl
