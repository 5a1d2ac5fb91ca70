#pragma once

#include "tabor/core/convergence.hpp"
#include "tabor/reynolds/patch_oil.hpp"

namespace tabor::reynolds {

/// The film of a patch after some sliding.
struct PatchFilm {
  Field pressure;            ///< p [Pa], >= 0; 0 at walls and where the gap is not full
  Field fill;                ///< theta, 0..1; 0 at walls
  PatchOil oil;              ///< where the oil is
  double mean_pressure = 0;  ///< [Pa], over the whole patch
  double dissipation = 0;    ///< of the flow that pressure drives [W/m^2], over the whole patch
  int steps = 0;             ///< in time
  /// Of one step: iterations of the sets of full and starved cells and products with the matrices
  /// of the full ones; converged if every cell's oil is accounted for and (almost) none is full
  /// that should be starved, stalled if some oil is not. The certificate compares the oil that
  /// cells gain too much with the flows. Of a steady film: of all its steps; converged if the last
  /// one is and changes nothing any more, stalled if the last one is. The certificate is that
  /// change of the mean pressure.
  Convergence convergence;
};

/// One implicit step of `time` [s] between surfaces that keep their distance: oil is carried along
/// x with u_m where the gap is partly full, and driven by pressure where it is full (Jakobsson,
/// Floberg and Olsson; Elrod 1981, doi:10.1115/1.3251669):
///
///   d(theta h)/dt + d(u_m theta h)/dx = div( h^3/(12 eta) grad p ) ,
///   p >= 0 , 0 <= theta <= 1 , p (1 - theta) = 0 .
///
/// Backward Euler, upwind; the sets of full and starved cells change until they fit. Oil moves over
/// faces only, so its volume is kept to round-off. The widest place of each room of the gap is its
/// vent: where the pressure there would exceed vent_pressure, oil leaves and is counted as
/// `outside`. `oil` must be settled in the rooms of these cells. A `guess` of the pressure (or an
/// empty field) saves iterations. Throws Interrupted.
PatchFilm advance(const PatchCells& cells, const Rooms& rooms, const PatchOil& oil, double time,
                  const Field& guess, const Observer& observer = {});

}  // namespace tabor::reynolds
