#pragma once

#include <string>
#include <vector>

#include "tabor/core/convergence.hpp"
#include "tabor/core/warning.hpp"
#include "tabor/ehl/impact/ball_film.hpp"

/// Elastohydrodynamic lubrication: films between elastic bodies.
namespace tabor::ehl {

/// How an impact begins.
enum class ImpactStart {
  rigid,  ///< in closed form, until the bodies deform (Larsson & Höglund 1994)
  full,   ///< all equations from the moment the ball touches the layer
};

/// A ball that falls on a flat covered with a layer of liquid. SI units.
struct ImpactProblem {
  double radius = 0;             ///< R [m], of the ball
  double mass = 0;               ///< m [kg]
  double speed = 0;              ///< of approach [m/s], > 0
  double effective_modulus = 0;  ///< E* [Pa]
  material::Lubricant lubricant;
  double layer = 0;    ///< h00 [m]
  double gravity = 0;  ///< [m/s^2], towards the flat
  ImpactStart start = ImpactStart::rigid;
  Index nodes = 300;
  double domain_radius = 0;  ///< [m]; 0: as far as the ball is wet when the full equations begin
  /// [s], the longest step unless the pressure follows its trend; 0: the dry contact time over 400
  double time_step = 0;
  std::vector<double> profile_times = {};  ///< [s], in ascending order
  bool keeps_all_profiles = false;         ///< at every instant instead
};

/// One instant of an impact.
struct ImpactInstant {
  double time = 0;              ///< [s], 0 where the ball touches the layer
  double force = 0;             ///< [N]
  double speed = 0;             ///< dh0/dt [m/s]
  double separation = 0;        ///< h0 [m]
  double central_film = 0;      ///< [m]
  double min_film = 0;          ///< [m]
  double deformation = 0;       ///< in the centre [m]
  double central_pressure = 0;  ///< [Pa]
  double max_pressure = 0;      ///< [Pa]
  double film_radius = 0;       ///< [m] of the film that has not torn
};

/// Film and pressure along the radius at one time.
struct ImpactProfile {
  double time = 0;          ///< [s]
  Eigen::ArrayXd pressure;  ///< [Pa], n + 1, zero at the edge
  Eigen::ArrayXd film;      ///< [m], n + 1
};

enum class ImpactEnd {
  rebound,     ///< the film carries nothing any more and the ball leaves
  sticks,      ///< the ball stopped in the liquid and did not come back
  unfinished,  ///< no step was short enough to converge, or the observer stopped it
};

/// The numbers of an impact. Values that do not exist are NaN.
struct ImpactMeasures {
  ImpactEnd end = ImpactEnd::unfinished;
  /// Convergence of Newton's method in all steps; certificate: the largest residual of a step, in
  /// units of the layer. Stalled where no step was short enough.
  Convergence convergence;
  double impact_time = 0;            ///< [s], until the force is 1e-4 of its maximum
  double max_force = 0;              ///< [N]
  double time_max_force = 0;         ///< [s]
  double min_film = 0;               ///< [m]
  double time_min_film = 0;          ///< [s]
  double turning_time = 0;           ///< [s], where the speed is zero
  double rebound_speed = 0;          ///< [m/s]
  double restitution = 0;            ///< rebound speed over approach speed
  double max_deformation = 0;        ///< [m], in the centre
  double primary_pressure = 0;       ///< [Pa], first peak in the centre, not the spike at the end
  double time_primary_pressure = 0;  ///< [s]
  double cavitation_time = 0;        ///< [s], where the film begins to shrink from the edge
  double full_start_time = 0;        ///< [s], end of the rigid stage
  double domain_radius = 0;          ///< [m]
  double time_step = 0;              ///< [s], nominal
  int n_steps = 0;
  int n_cut_steps = 0;
  StepCount count;
};

/// An impact.
struct ImpactResult : ImpactMeasures {
  std::vector<ImpactInstant> history;  ///< at least one
  std::vector<ImpactProfile> profiles;
  Eigen::ArrayXd radius;  ///< [m] of the nodes of the profiles, n + 1
  std::string reason;     ///< of the end, in one line, unless it is a rebound or was stopped
  Warnings warnings;      ///< laws used beyond where they are believed, ...
};

/// Throws InputError for invalid input: values that are not positive, a layer or a
/// domain too small for the contact that the ball would make when dry, a viscosity law that ends
/// below the pressure of that contact. Not converging is returned, and so is being stopped.
ImpactResult solve_impact(const ImpactProblem& problem, const Observer& observer = {});

}  // namespace tabor::ehl
