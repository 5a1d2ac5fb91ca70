#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tabor/core/warning.hpp"
#include "tabor/friction/bowden_tabor.hpp"
#include "tabor/friction/fluid_film.hpp"

// Summarises a contact whose load is shared with a flowing film, and its friction.
namespace tabor::friction {

/// Oil of a flowing film, as a user gives it.
struct FlowingOil {
  double viscosity = 0;                      ///< at ambient pressure [Pa s], > 0
  std::optional<double> pressure_viscosity;  ///< of Roelands' law [1/Pa]; absent: constant
  std::optional<double> eyring_stress;       ///< of Ree and Eyring's law [Pa]; absent: Newtonian
};

/// Returns the laws of an oil. Throws InputError for values out of range.
material::Lubricant lubricant_of(const FlowingOil& oil);

/// Numbers that a user reads about a state with flowing oil (docs/fluid_film.md). None depends on
/// the shear strength of the solids.
struct FluidSummary {
  double load_share = 0;                    ///< of the oil: mean(p)/P
  double solid_share = 0;                   ///< of the solids
  double max_pressure = 0;                  ///< of the oil [Pa]
  double contact_area_fraction = 0;         ///< while sliding, perimeter-corrected
  double contact_area_fraction_pixels = 0;  ///< counted
  double lubricated_share = 0;              ///< of that contact, by the oil as deposited
  double mean_gap = 0;                      ///< [m]
  double full_fraction = 0;                 ///< share of the pixels whose gap is full
  double outside_film = 0;    ///< oil that the gap cannot hold, over the nominal area [m]
  double viscous_stress = 0;  ///< [Pa]
  double load_error = 0;
  double gap_error = 0;
  double pressure_error = 0;
  int film_iterations = 0;  ///< of the last film
  Convergence convergence;  ///< as that of FluidFilmState
};

/// Computes the numbers of a state, over the patch.
FluidSummary summarise(const FluidFilmState& state, const FluidFilmProblem& problem,
                       const Grid& grid);

/// Friction coefficients of the solids that still touch, of the oil, and of both.
struct MixedEstimate {
  double area_fraction = 0;  ///< A_real / A0 of the solids that was used
  double friction_solid = 0;
  double friction_viscous = 0;
  double friction_mixed = 0;
};

/// Estimates friction: that of the solids by Bowden & Tabor's rule, and the shear of the oil, each
/// over P [Pa]. Throws InputError as estimate().
MixedEstimate estimate(const FluidSummary& fluid, double mean_pressure, double saturation_pressure,
                       double shear_strength, Area area = Area::corrected,
                       double boundary_shear_strength = 0);

/// Returns one warning for each problem of the state: not converged, laws outside their trusted
/// range, an oil pressure that the solids would not bear.
Warnings warnings(const FluidFilmState& state, const FluidFilmProblem& problem);

}  // namespace tabor::friction
