#pragma once

#include <string>
#include <vector>

#include "tabor/core/convergence.hpp"
#include "tabor/core/warning.hpp"

// Solves a roller that closes on a sliding flat under a layer of liquid.
namespace tabor::ehl {

/// A roller that closes on a flat under a layer of liquid while the surfaces slide, per unit width:
/// the liquid between rigid surfaces, an elastic spring between it and the roller (Larsson's
/// thesis, paper C).
struct SqueezeProblem {
  double mass = 0;                  ///< m [kg/m]
  double radius = 0;                ///< R [m], effective
  double spring = 0;                ///< k_e [N/m^2]
  double speed = 0;                 ///< of approach [m/s], > 0
  double viscosity = 0;             ///< eta0 [Pa s]
  double pressure_coefficient = 0;  ///< alpha of Barus' law [1/Pa], 0 for a constant viscosity
  double layer = 0;                 ///< h00 [m]
  double sliding_speed = 0;         ///< Vs [m/s], >= 0: one surface moves, u_m = Vs / 2
  double gravity = 9.81;            ///< [m/s^2]
  double time_step = 0;             ///< [s]; 0: the layer over 2000 times the speed
};

/// One instant.
struct SqueezeInstant {
  double time = 0;          ///< [s]
  double film = 0;          ///< h0 [m]
  double film_speed = 0;    ///< dh0/dt [m/s]
  double roller = 0;        ///< hr [m]: h0 = hr + W / k_e
  double roller_speed = 0;  ///< [m/s]
  double force = 0;         ///< W [N/m]
};

/// The numbers of a squeezed film. Values that do not exist are NaN.
struct SqueezeMeasures {
  double max_force = 0;       ///< [N/m]
  double time_max_force = 0;  ///< [s]
  double min_film = 0;        ///< [m]
  double time_min_film = 0;   ///< [s]
  double turning_time = 0;    ///< [s], where the roller stops closing
  double lag = 0;             ///< [s] of the smallest film behind the largest force
  bool gap_closing_at_turning = false;
  Convergence convergence;  ///< of the film of each instant; stalled where no film bears the force
};

/// A squeezed film.
struct SqueezeResult : SqueezeMeasures {
  std::string reason;  ///< of an end without a turning, one line
  Warnings warnings;
  std::vector<SqueezeInstant> history;
};

/// [N/m] Load of a film h0 + x^2/(2 R) under Barus' law that slides at Vs and changes at dh0/dt:
/// (h^3 q')' = eta0 (6 Vs h' + 12 dh0/dt), p = -ln(1 - alpha q)/alpha, Reynolds' exit. q is known
/// in closed form with x = sqrt(2 R h0) tan(theta). Infinite where alpha q reaches 1: the film is
/// too thin.
double squeeze_slide_load(const SqueezeProblem& problem, double film, double film_speed);

/// Follows the roller until the gap opens again. Throws InputError for values that are not
/// positive. A roller that was stopped is returned where it was.
SqueezeResult solve_squeeze(const SqueezeProblem& problem, const Observer& observer = {});

/// m x'' + c x' + k x = 0, x(0) = 0, x'(0) = v: the film as a spring and a damper (c < 2 sqrt(k
/// m)).
struct LinearSqueeze {
  double mass = 0;       ///< m [kg/m]
  double stiffness = 0;  ///< k [N/m^2]
  double damping = 0;    ///< c [N s/m^2]
  double speed = 0;      ///< v [m/s]

  double angular_frequency() const;  ///< w = sqrt(k/m - c^2/(4 m^2)) [1/s]
  double phase()
      const;  ///< phi by which the force is ahead: sin(phi) = c sqrt(4 k m - c^2)/(2 k m)
  double displacement(double time) const;  ///< x [m]
  double force(double time) const;         ///< k x + c x' [N/m]
  double time_max_displacement() const;    ///< [s]
  double time_max_force() const;           ///< [s], 0 if the force falls from the beginning
};

}  // namespace tabor::ehl
