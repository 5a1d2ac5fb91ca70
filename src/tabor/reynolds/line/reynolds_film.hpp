#pragma once

#include "tabor/core/convergence.hpp"
#include "tabor/reynolds/line/reynolds.hpp"

// Solves Reynolds' equation along a line or radius for a film of known shape, with cavitation.
namespace tabor::reynolds {

/// Cavitation model: condition where the pressure would fall below the cavitation pressure.
enum class Cavitation {
  none,             ///< pressures may be negative (full Sommerfeld)
  reynolds,         ///< p >= p_c by complementarity: p = p_c and dp/dx = 0 at the rupture front
  penalty,          ///< Wu 1986: a source -min(0, p - p_c)/eps; tends to `reynolds` with eps -> 0
  mass_conserving,  ///< p-theta of Jakobsson, Floberg and Olsson: p = p_c where theta < 1
};

/// Film of known shape between rigid surfaces. Lengths, speeds and pressures in SI.
struct FilmProblem {
  FilmGrid grid;
  Eigen::ArrayXd film;           ///< h [m] at the n + 2 nodes, > 0
  Eigen::ArrayXd squeeze = {};   ///< dh/dt [m/s] at the n cells; empty is zero
  Eigen::ArrayXd old_mass = {};  ///< rho theta h [kg/m^2] at the n cells a time step ago
  double time_step = 0;          ///< [s]; > 0: backward Euler from old_mass, squeeze is not used
  double speed = 0;              ///< u [m/s], mean of both walls
  double left_pressure = 0;      ///< [Pa]
  double right_pressure = 0;
  double cavitation_pressure = 0;
  Cavitation cavitation = Cavitation::reynolds;
  double penalty = 1e6;  ///< 1/eps in units of the largest rho h^3/(12 eta) over length squared
  material::Lubricant liquid;  ///< viscosity and density; flows as if Newtonian
  double density = 1;          ///< rho0 [kg/m^3]; 1 for flows by volume
};

struct FilmSolution {
  Eigen::ArrayXd pressure;   ///< [Pa], n + 2
  Eigen::ArrayXd fill;       ///< theta, n + 2
  Eigen::ArrayXd mass;       ///< rho theta h [kg/m^2] at the cells, n
  Eigen::ArrayXd face_flow;  ///< width times m, n + 1: [kg/(m s)] (line) or [kg/s] (disc)
  double load = 0;           ///< integral of p over the cells [N/m] or [N]
  Convergence convergence;   ///< certificate: largest imbalance of a full cell over largest flow
};

/// Solves by Newton's method for the pressures (and fills), with the cells of the cavity as a set
/// that changes between iterations (primal-dual active set). Throws InputError for arrays of wrong
/// size and films that are not above zero; not converging is returned.
FilmSolution solve_film(const FilmProblem& problem);

}  // namespace tabor::reynolds
