#pragma once

#include "tabor/contact/contact.hpp"
#include "tabor/material/lubricant.hpp"
#include "tabor/reynolds/patch/patch_flow.hpp"

// Shares the load between a rough contact and an oil film that flows in its gap.
namespace tabor::friction {

/// Problem of a smooth flat that slides over a rough surface at rest, with oil between them.
/// docs/fluid_film.md has the equations and their limits.
struct FluidFilmProblem {
  contact::Problem contact;       ///< height, load, saturation, tolerance of the contact
  Field film;                     ///< oil as deposited [m], shape of the height
  double sliding_speed = 0;       ///< u [m/s], along +x, >= 0
  material::Lubricant lubricant;  ///< viscosity and shear; the density plays no part
  double tolerance = 1e-3;   ///< of load balance and fluid's pressure over P, of the gap over its
                             ///< mean
  int max_evaluations = 40;  ///< of contact and film together
};

/// Solution: a contact and the film that carries a part of its load.
struct FluidFilmState {
  contact::State contact;  ///< pressure of the solids alone; gap and displacement under both
  reynolds::PatchFilm film;
  double solid_pressure = 0;  ///< mean over the patch [Pa]
  double fluid_pressure = 0;  ///< mean over the patch [Pa]
  double viscous_stress = 0;  ///< mean shear stress that the oil puts on the flat [Pa]
  double mean_gap = 0;        ///< [m]
  /// Its iterations are evaluations of contact and film together, its certificate is the largest of
  /// the three errors below. Stalled where the carried load jumps across P.
  Convergence convergence;
  double load_error = 0;  ///< (solid + fluid pressure)/P - 1
  double gap_error = 0;   ///< rms of the last change of the gap by the fluid's pressure, over the
                          ///< mean gap
  double pressure_error = 0;  ///< mean difference of the fluid's pressure from the one that deforms
                              ///< the surface, over P
};

/// Shares the load between the solids and the oil: the solids are in dry contact under the load
/// that the film does not carry, on the surface as the film's pressure has deformed it; the film
/// flows in the remaining gap (reynolds/patch/patch_flow.hpp). Where the oil alone carries the
/// load, the surfaces separate. `dry` is the contact's state at P without oil: the search starts
/// there, and it is the solution where the oil carries less than the tolerance. The operator must
/// be periodic. Throws InputError for invalid input; not converging is returned, and so is being
/// stopped: with what was reached, in which the film has no fields before its first step.
FluidFilmState solve_fluid_film(elastic::ElasticOperator& elasticity,
                                const FluidFilmProblem& problem, const contact::State& dry,
                                const Observer& observer = {});

}  // namespace tabor::friction
