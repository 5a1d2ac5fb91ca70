#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "tabor/core/convergence.hpp"
#include "tabor/core/types.hpp"
#include "tabor/core/warning.hpp"
#include "tabor/ehl/asperities.hpp"
#include "tabor/material/lubricant.hpp"
#include "tabor/reference/ehl_films.hpp"
#include "tabor/reference/hertz_line.hpp"

// Solves the lubricated contact of a cylinder with a flat.
namespace tabor::ehl {

/// What happens where the liquid would be pulled below zero pressure.
enum class LineCavitation {
  reynolds,  ///< p >= 0 by complementarity: p = dp/dx = 0 where the film breaks
  penalty    ///< a source -min(0, p)/eps (Wu 1986); tends to `reynolds` with eps -> 0
};

/// A cylinder on a flat with a film between, steady, plane strain, flow towards +x. SI units.
struct LineProblem {
  double radius = 0;             ///< R [m]
  double effective_modulus = 0;  ///< E* [Pa]
  double load = 0;               ///< F [N/m]
  double entrainment_speed = 0;  ///< u_m [m/s], mean of the speeds of both surfaces, > 0
  double sliding_speed = 0;      ///< u_s [m/s], their difference, for friction
  material::Lubricant lubricant;
  LineCavitation cavitation = LineCavitation::reynolds;
  double penalty = 1e6;  ///< 1/eps in units of u_m over the pressure of Hertz
  Index nodes = 1200;
  double inlet = 0;   ///< [m] before the centre; 0: 4 half widths and 10 sqrt(2 R h), at least
                      ///< 30 sqrt(2 R h), h by Moes
  double outlet = 0;  ///< [m] behind it; 0: 1.5 half widths and 3 sqrt(2 R h)
  Eigen::ArrayXd roughness;  ///< s [m] at the nodes, asperities up, at rest; empty: smooth
  /// No boundary film: nothing touches. Liquid goes on through it, as in a real contact it goes
  /// round the summits, which a profile cannot show.
  Asperities asperities;
};

/// The numbers of a film.
struct LineMeasures {
  double separation = 0;    ///< h0 [m], of the undeformed bodies; relative, see LineHalfSpace
  double min_film = 0;      ///< [m]
  double central_film = 0;  ///< [m] at x = 0
  double max_pressure = 0;  ///< [Pa] of p + P
  double max_pressure_before_spike =
      0;               ///< [Pa] of p; less where the grid cannot show the spike at the outlet
  double rupture = 0;  ///< [m] where the pressure ends
  double friction_force = 0;        ///< [N/m] of liquid and solids
  double friction_coefficient = 0;  ///< friction_force over load
  double friction_fluid = 0;        ///< its part from the film sheared where it carries pressure
  double friction_solid = 0;        ///< its part from asperities
  double asperity_load_share = 0;   ///< of the load
  double contact_width = 0;         ///< [m] of all nodes that touch
  double max_shear_stress = 0;      ///< [Pa] of the film
  double load_error = 0;            ///< relative
  double mass_error = 0;            ///< largest imbalance of a node over the flow in the contact
  double contact_error = 0;         ///< largest P (h - h_b) over pressure and film of the contact
  Convergence convergence;          ///< of Newton's method; certificate: mass_error
};

/// A film. Arrays hold one value per node.
struct LineResult : LineMeasures {
  Eigen::ArrayXd x;                  ///< [m] from the line of closest approach
  Eigen::ArrayXd pressure;           ///< p [Pa] of the liquid
  Eigen::ArrayXd film;               ///< h [m], h_b where solids touch
  Eigen::ArrayXd asperity_pressure;  ///< P [Pa]; empty if nothing can touch
  /// [Pa] on the surface: of the film where it carries pressure, of solids where they touch (NaN if
  /// asperities have no law), 0 elsewhere.
  Eigen::ArrayXd shear_stress;
  Eigen::ArrayXd local_friction;  ///< shear_stress over p + P; 0 where nothing carries pressure
  /// Part of the roughness under which this film was found: less than 1 where it has not converged
  /// under all of it, but did under less.
  double roughness_share = 1;
  Warnings warnings;
};

/// Hertz' dry contact and the groups of the lubricated one.
reference::HertzLineContact hertz_of(const LineProblem& problem);
reference::LineContactFilm film_groups_of(const LineProblem& problem);

/// Nodes that solve_line() uses [m]: uniform, from -inlet to outlet.
Eigen::ArrayXd line_nodes(const LineProblem& problem);

/// Heights s [m] at the nodes of line_nodes(): one asperity, `height` cos^2(pi (x - place)/width)
/// within half a width of its place. Throws InputError if the grid has less than 8 nodes for it or
/// it does not lie between the ends of the domain.
Eigen::ArrayXd line_asperity(const LineProblem& problem, double height, double width, double place);
/// Waves s = amplitude sin(2 pi x / wavelength) [m], as in Akchurin's thesis. Throws likewise.
Eigen::ArrayXd line_waves(const LineProblem& problem, double amplitude, double wavelength);

/// A measured profile, heights [m] `spacing` [m] apart, levelled, its middle in the middle of the
/// domain, between its points by straight lines. Throws InputError if it is shorter than the domain
/// or has holes.
Eigen::ArrayXd line_profile(const LineProblem& problem, const Eigen::ArrayXd& height,
                            double spacing);

/// What one asperity changes between its edges, against the film of the same bodies without it.
/// Friction is without a value where nothing carries pressure there.
struct AsperityEffect {
  double local_friction = 0;         ///< largest |shear stress| over pressure
  double smooth_local_friction = 0;  ///< the same without the asperity
  double max_pressure = 0;           ///< [Pa] of p + P
  double smooth_max_pressure = 0;    ///< [Pa]

  /// How many times the asperity raises local friction.
  double friction_ratio() const { return local_friction / smooth_local_friction; }
  /// How many times it raises the largest pressure.
  double pressure_ratio() const { return max_pressure / smooth_max_pressure; }
};

/// Returns the effect of an asperity `width` [m] wide at `place` [m]. Both films have the same
/// nodes.
AsperityEffect asperity_effect(const LineResult& rough, const LineResult& smooth, double width,
                               double place);

/// Fills what follows from x, pressure and film.
void measure_line(const LineProblem& problem, LineResult& result);

/// Throws InputError as solve_line() does.
void check_line(const LineProblem& problem);

/// Newton's method on pressures and h0 together, the load being one of the equations, from the
/// pressure of Hertz. With asperities P >= 0, h >= h_b and P (h - h_b) = 0 are
/// solved along with it, p + P deflects and carries the load, and P does not enter Reynolds'
/// equation. Throws InputError for invalid input: values that are not positive, a
/// domain that does not contain the contact, a grid too coarse for it, a viscosity law that ends
/// below the pressure of Hertz. Not converging is returned, and so is being stopped.
LineResult solve_line(const LineProblem& problem, const Observer& observer = {});

}  // namespace tabor::ehl
