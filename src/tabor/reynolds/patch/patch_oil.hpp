#pragma once

#include "tabor/reynolds/patch/patch_cells.hpp"

// Distributes the deposited oil over the gap that remains when the surfaces close.
namespace tabor::reynolds {

/// Oil of a patch after the surfaces have closed on it.
struct PatchOil {
  Field volume;        ///< per area of the cell [m]; a cell that is pressed on may hold more than h
  double outside = 0;  ///< per area of a cell [m], summed: oil that the gap cannot hold
};

/// Distributes oil over the open cells: oil on solid cells moves to the nearest open cell; the
/// excess of a connected component of the gap, and `outside`, spreads over the free volume of the
/// others in proportion (oil that leaves a periodic patch enters it again elsewhere). Oil is
/// conserved: the sum of the volumes and `outside` stays constant to round-off.
PatchOil settle(const PatchCells& cells, const Components& components, const Field& oil,
                double outside);

}  // namespace tabor::reynolds
