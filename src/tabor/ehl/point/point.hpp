#pragma once

#include <limits>
#include <string>
#include <vector>

#include "tabor/core/convergence.hpp"
#include "tabor/core/types.hpp"
#include "tabor/core/warning.hpp"
#include "tabor/ehl/asperities.hpp"
#include "tabor/material/lubricant.hpp"
#include "tabor/reference/ehl_films.hpp"
#include "tabor/reference/hertz_ellipse.hpp"

// Solves the lubricated contact of a ball or ellipsoid with a flat.
namespace tabor::ehl {

inline constexpr double kNoPlasticLimit = std::numeric_limits<double>::infinity();

/// A ball or ellipsoid on a flat with a film between, isothermal, flow towards +x (columns). SI
/// units. Arrays have shape (nodes_y, nodes_x); node (j, i) lies at point_x()[i], point_y()[j].
struct PointProblem {
  double radius_x = 0;           ///< Rx [m], reduced, along the flow
  double radius_y = 0;           ///< Ry [m], across it
  double effective_modulus = 0;  ///< E* [Pa]; the papers' E' is 2 E*
  double load = 0;               ///< w [N]
  double entrainment_speed = 0;  ///< u_m [m/s], mean of the speeds of both surfaces, > 0
  double sliding_speed = 0;      ///< u_s [m/s], their difference, for shear thinning and friction
  material::Lubricant lubricant;
  double plastic_pressure = kNoPlasticLimit;  ///< P_plast [Pa], a cap on the whole pressure
  /// Solids touch where no more than the boundary film is left, which must be > 0; their friction
  /// is that of what touches without flowing.
  Asperities asperities{.boundary_film = 1e-9};
  Index nodes_x = 257;
  Index nodes_y = 257;
  double inlet = 4.5;       ///< domain before the centre, in half axes of the Hertz ellipse
  double outlet = 1.5;      ///< behind it
  double half_width = 3;    ///< to either side
  Field roughness;          ///< s [m], asperities up, at rest; empty: smooth
  double tolerance = 1e-6;  ///< on the largest relative residual: flow, load
  int max_iterations = 60;
};

/// A film under pressure, part of it perhaps carried by touching solids. p_total = pressure +
/// contact_pressure; film >= 0. Solids touch where film = 0, that is where no more than the
/// boundary film is left, and where they flow; contact_pressure > 0 and pressure = 0 there.
/// plastic_depth > 0 only where p_total = P_plast.
struct PointResult {
  Grid grid;                     ///< cells around the nodes
  Field pressure;                ///< p [Pa], of the liquid
  Field contact_pressure;        ///< P_num [Pa], of touching solids; empty if there is none
  Field film;                    ///< h [m]
  Field plastic_depth;           ///< h_plast [m]; empty without plastic_pressure
  double separation = 0;         ///< h00 [m]
  double entrainment_speed = 0;  ///< u_m [m/s] of a mixed film, else 0
  double load_error = 0;         ///< relative
  double mass_error = 0;         ///< largest imbalance of a cell over the flow through the contact
  /// Convergence of Newton's method; certificate: the larger error. Operator applications are those
  /// beside the inverse.
  Convergence convergence;
  int n_linear_iterations = 0;  ///< of GMRES
  Warnings warnings;
};

/// Dry contact and the groups of the lubricated one.
reference::HertzEllipse hertz_of(const PointProblem& problem);
reference::PointContactFilm film_groups_of(const PointProblem& problem);

/// Nodes along x and y [m] from the centre of the contact, uniform.
Eigen::ArrayXd point_x(const PointProblem& problem);
Eigen::ArrayXd point_y(const PointProblem& problem);

/// Cells around these nodes.
Grid point_grid(const PointProblem& problem);

/// Throws InputError as solve_point() does.
void check_point(const PointProblem& problem);

/// Newton's method on pressures and h00 together; with roughness or a cap on the pressure, or where
/// the film would be thinner than the boundary film, on plastic depths and contact as well (see
/// solve_point_mixed()). `start`: a result of the same problem at a nearby
/// speed or load (continuation), or null. Throws InputError for invalid input; not
/// converging is returned, and so is being stopped, after which nothing else is tried.
PointResult solve_point(const PointProblem& problem, const PointResult* start = nullptr,
                        const Observer& observer = {});

}  // namespace tabor::ehl
