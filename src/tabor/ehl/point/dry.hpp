#pragma once

#include "tabor/ehl/point/point.hpp"

// Solves the contact of the bodies of a point contact without liquid.
namespace tabor::ehl {

/// The dry contact of the bodies of `problem`, with its roughness and its cap P_plast on the
/// pressure: what a film tends to as the speed vanishes. All the pressure is contact_pressure and
/// pressure is zero; plastic_depth is the residual indentation of nodes at P_plast (material of
/// ideal plasticity, loaded once). Solved by contact::solve() on the free half-space. Throws
/// InputError as solve_point() does. Not converging is returned; a contact that reaches the border
/// of the domain carries a warning.
PointResult solve_point_dry(const PointProblem& problem, const Observer& observer = {});

/// Height [m] of the undeformed bodies over the plane that touches the smooth one, asperities up:
/// roughness - x^2/2Rx - y^2/2Ry at the nodes.
Field point_height(const PointProblem& problem);

}  // namespace tabor::ehl
