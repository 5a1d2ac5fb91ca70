#pragma once

#include "tabor/ehl/impact/impact.hpp"

// Follows a rigid ball into an isoviscous layer in closed form, until the bodies deform.
namespace tabor::ehl {

/// The ball while it is still rigid and the liquid isoviscous.
struct Approach {
  double time = 0;        ///< [s]
  double separation = 0;  ///< h0 [m]
  double speed = 0;       ///< dh0/dt [m/s], negative
  double force = 0;       ///< [N]
};

/// [N] Force on a rigid ball in an isoviscous layer, -6 pi eta0 v R^2/h0 ((h00 - h0)/h00)^2.
double rigid_squeeze_force(const ImpactProblem& problem, double separation, double speed);

/// [Pa] Its pressure at radius r, -3 eta0 R v (1/h^2 - 1/h00^2), 0 outside the wet disc.
double rigid_squeeze_pressure(const ImpactProblem& problem, double separation, double speed,
                              double r);

/// The rigid stage from the moment the ball touches the layer until a Hertz contact under the force
/// would be deformed by 1 % of h0: m v dv/dh0 = w - m g by Runge-Kutta's method. The last entry is
/// where it ends; if the ball stops before, its speed is zero.
std::vector<Approach> rigid_approach(const ImpactProblem& problem);

}  // namespace tabor::ehl
