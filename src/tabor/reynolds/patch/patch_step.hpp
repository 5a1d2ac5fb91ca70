#pragma once

#include "tabor/core/convergence.hpp"
#include "tabor/reynolds/patch/patch_oil.hpp"

// Advances the oil of a rough patch by one implicit step in time.
namespace tabor::reynolds {

/// Film of a patch after some sliding.
struct PatchFilm {
  Field pressure;            ///< p [Pa], >= 0; 0 at solid cells and where the gap is not full
  Field fill;                ///< theta, 0..1; 0 at solid cells
  PatchOil oil;              ///< where the oil is
  Field unit;                ///< [Pa] in which the next step measures the pressure of each cell
  double mean_pressure = 0;  ///< [Pa], over the whole patch
  double dissipation = 0;    ///< of the flow that pressure drives [W/m^2], over the whole patch
  int steps = 0;             ///< in time
  /// Convergence of one step: iterations of the sets of full and starved cells and products with
  /// the matrices of the full ones; converged if the oil of every cell balances and (almost) no
  /// cell is full that should be starved, stalled if some oil does not balance. The certificate
  /// compares the excess inflow of cells with the flows. For a steady film it counts all its steps;
  /// converged if the last step is and changes nothing any more, stalled if the last step is. The
  /// certificate is then the change of the mean pressure.
  Convergence convergence;
};

/// Advances the oil by one implicit step of `time` [s] between surfaces of fixed distance: oil is
/// carried along x with u_m where the gap is partly full, and driven by pressure where it is full
/// (Jakobsson, Floberg and Olsson; Elrod 1981, doi:10.1115/1.3251669):
///
///   d(theta h)/dt + d(u_m theta h)/dx = div( h^3/(12 eta) grad p ) ,
///   p >= 0 , 0 <= theta <= 1 , p (1 - theta) = 0 .
///
/// Backward Euler, upwind; the sets of full and starved cells change until they are consistent. Oil
/// moves over faces only, so its volume is conserved to round-off. The widest place of each
/// connected component of the gap is its vent: where the pressure there would exceed vent_pressure,
/// oil leaves and is counted as `outside`. `oil` must be settled in the components of these cells.
/// The pressure and the unit of a `guess` (or empty fields) save iterations. Throws Interrupted.
PatchFilm advance(const PatchCells& cells, const Components& components, const PatchOil& oil,
                  double time, const PatchFilm& guess, const Observer& observer = {});

}  // namespace tabor::reynolds
