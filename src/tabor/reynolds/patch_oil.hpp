#pragma once

#include "tabor/reynolds/patch_cells.hpp"

namespace tabor::reynolds {

/// The oil of a patch after the surfaces have closed on it.
struct PatchOil {
  Field volume;        ///< per area of the cell [m]; a cell that is pressed on may hold more than h
  double outside = 0;  ///< per area of a cell [m], summed: what found no room on the patch
};

/// Moves oil to where there is room: what stands on walls goes to the nearest open cell; what a
/// room of the gap cannot hold, and `outside`, spreads over the free room of the others in
/// proportion (what leaves a patch that repeats enters it again elsewhere). No oil is made or lost:
/// the sum of the volumes and `outside` stays what it was, to round-off.
PatchOil settle(const PatchCells& cells, const Rooms& rooms, const Field& oil, double outside);

}  // namespace tabor::reynolds
