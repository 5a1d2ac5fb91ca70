#pragma once

#include <vector>

#include "tabor/deposition/pools.hpp"
#include "tabor/deposition/ranks.hpp"

// Finds where the pixels of a surface with ordered ties drain to, and where its basins meet.
namespace tabor::deposition {

/// Basins of a surface, numbered by their lowest pixels; beyond an open edge lies the first, the
/// ocean.
struct Basins {
  std::vector<Rank> bottoms;  ///< per basin its lowest pixel; below all pixels that of the ocean
  UnwrittenVector<PoolId> of_pixel;  ///< per pixel the basin at the end of its steepest descent
  /// Pixels, ascending, whose lower neighbours are not connected by lower pixels among the eight
  /// around them: only there can pools meet (the join saddles of Chiang, Lenz, Lu & Rote 2005).
  std::vector<Rank> saddles;
};

Basins find_basins(const Terrain& terrain);

}  // namespace tabor::deposition
