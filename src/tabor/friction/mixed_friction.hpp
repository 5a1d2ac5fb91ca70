#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tabor/friction/bowden_tabor.hpp"
#include "tabor/friction/fluid_film.hpp"

namespace tabor::friction {

/// The oil of a film that flows, as a user gives it.
struct FlowingOil {
  double viscosity = 0;                      ///< at ambient pressure [Pa s], > 0
  std::optional<double> pressure_viscosity;  ///< of Roelands' law [1/Pa]; absent: constant
  std::optional<double> eyring_stress;       ///< of Ree and Eyring's law [Pa]; absent: Newtonian
};

/// Its laws. Throws InputError for values out of range.
material::Lubricant lubricant_of(const FlowingOil& oil);

/// What a user reads about a state whose oil flows (docs/fluid_film.md). Nothing in it depends on
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
  double outside_film = 0;                  ///< oil without room, over the nominal area [m]
  double viscous_stress = 0;                ///< [Pa]
  double load_error = 0;
  double gap_error = 0;
  double pressure_error = 0;
  int film_iterations = 0;  ///< of the last film
  Convergence convergence;  ///< as that of FluidFilmState
};

/// The numbers of a state, over the patch.
FluidSummary summarise(const FluidFilmState& state, const FluidFilmProblem& problem,
                       const Grid& grid);

/// Friction of the solids that still touch, of the oil, and of both.
struct MixedEstimate {
  double area_fraction = 0;  ///< A_real / A0 of the solids that was used
  double friction_solid = 0;
  double friction_viscous = 0;
  double friction_mixed = 0;
};

/// Bowden & Tabor's estimate for what the solids carry, and the oil's shear: over P [Pa] each.
/// Throws InputError as estimate().
MixedEstimate estimate(const FluidSummary& fluid, double mean_pressure, double saturation_pressure,
                       double shear_strength, Area area = Area::corrected,
                       double boundary_shear_strength = 0);

/// One line for each reason to doubt the state: not converged, laws beyond where they are believed,
/// an oil whose pressure the solids would not bear.
std::vector<std::string> warnings(const FluidFilmState& state, const FluidFilmProblem& problem);

}  // namespace tabor::friction
