#pragma once

#include "tabor/contact/contact.hpp"
#include "tabor/material/lubricant.hpp"
#include "tabor/reynolds/patch_flow.hpp"

namespace tabor::friction {

/// A smooth flat that slides over a rough surface at rest, with oil between them.
/// docs/fluid_film.md has the equations and what they leave out.
struct FluidFilmProblem {
  contact::Problem contact;       ///< height, mean pressure P, saturation, tolerance of the contact
  Field film;                     ///< oil as deposited [m], shape of the height
  double sliding_speed = 0;       ///< u [m/s], along +x, >= 0
  material::Lubricant lubricant;  ///< viscosity and shear; the density plays no part
  double tolerance = 1e-3;   ///< of load balance and fluid's pressure over P, of the gap over its
                             ///< mean
  int max_evaluations = 40;  ///< of contact and film together
};

/// A contact and the film that carries a part of its load.
struct FluidFilmState {
  contact::State contact;  ///< pressure of the solids alone; gap and displacement under both
  reynolds::PatchFilm film;
  double solid_pressure = 0;  ///< mean over the patch [Pa]
  double fluid_pressure = 0;  ///< mean over the patch [Pa]
  double viscous_stress = 0;  ///< mean shear stress that the oil puts on the flat [Pa]
  double mean_gap = 0;        ///< [m]
  /// Evaluations of contact and film together are its iterations, the largest of the three errors
  /// below its certificate. Stalled where the load jumps across what the oil could carry.
  Convergence convergence;
  double load_error = 0;  ///< (solid + fluid pressure)/P - 1
  double gap_error = 0;   ///< rms of what the last change of the fluid's pressure moves the gap by,
                          ///< over the mean gap
  double pressure_error = 0;  ///< mean of what the fluid's pressure is beside the one that the
                              ///< surface has given way to, over P
};

/// Shares the load between the solids and the oil: the solids are in dry contact under what the
/// film does not carry, on the surface as the film's pressure has deformed it; the film flows in
/// the gap they leave (reynolds/patch_flow.hpp). Where oil alone carries the load the surfaces
/// part. `dry` is the contact's state at P without oil: it begins the search, and is the answer
/// where the oil carries less than the tolerance. The operator must be periodic. Throws InputError
/// for invalid input; not converging is returned, and so is being stopped: with
/// what was reached, in which the film has no fields before its first step.
FluidFilmState solve_fluid_film(elastic::ElasticOperator& elasticity,
                                const FluidFilmProblem& problem, const contact::State& dry,
                                const Observer& observer = {});

}  // namespace tabor::friction
