#pragma once

#include "tabor/ehl/point/point.hpp"

// How far grid and domain of a point contact are from those that no longer matter, before anything
// is solved.
namespace tabor::ehl {

/// By which share of itself the central film of a smooth contact is too thin on this grid: c / (n^2
/// + 1.65 c) with n the nodes in the inlet, over which the film is built up, and c = 0.09 + 0.022
/// L, at most 0.2. Fitted within a factor of 1.7 to grids of 49 to 385 nodes at M = 20 to 500, L =
/// 0 to 10. Where the oil thins under shear (it slides and is not Newtonian), c is 2.5 times as
/// large: within 1.7 at M = 830 to 4700, L = 9 to 17, tau_E of 3 to 20 MPa and pure sliding.
/// tests/ehl/point/accuracy_test.cpp compares with finer grids.
double point_grid_error(const PointProblem& problem);

/// By which share of itself the central film is too thin because the domain ends: the load that
/// pressure outside would carry, times d ln Hc / d ln M of Nijenbanning's formula. Far from the
/// contact of a rigid ball p = 9.6 eta u_m R^2 |x| / r^4, which solves Reynolds' equation in the
/// gap r^2 / (2 R).
double point_domain_error(const PointProblem& problem);

/// The same problem on a domain, and if `chooses_nodes` on a grid, whose errors are about a
/// hundredth each, or as small as the largest domain and grid allow.
PointProblem with_domain_chosen(PointProblem problem, bool chooses_nodes, double most_axes);

}  // namespace tabor::ehl
