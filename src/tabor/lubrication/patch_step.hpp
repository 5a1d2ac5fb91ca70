#pragma once

#include "tabor/core/convergence.hpp"
#include "tabor/lubrication/patch_oil.hpp"

namespace tabor::lubrication {

/// The film of a patch after some sliding.
struct PatchFilm {
  Field pressure;            ///< p [Pa], >= 0; 0 at walls and where the gap is not full
  Field fill;                ///< theta, 0..1; 0 at walls
  PatchOil oil;              ///< where the oil is
  double mean_pressure = 0;  ///< [Pa], over the whole patch
  double dissipation = 0;    ///< of the flow that pressure drives [W/m^2], over the whole patch
  int steps = 0;             ///< in time
  int iterations = 0;        ///< of the sets of full and starved cells
  int products = 0;          ///< with the matrices of the full cells
  bool balanced = false;     ///< of the last step: every cell's oil is accounted for
  bool converged = false;    ///< and (almost) no cell is full that should be starved
  bool steady = false;       ///< nothing changes any more
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

}  // namespace tabor::lubrication
