#pragma once

#include <vector>

#include "tabor/core/large_pages.hpp"
#include "tabor/deposition/pools.hpp"
#include "tabor/deposition/ranks.hpp"

// Finds where the pixels of a surface with ordered ties drain to, and where its basins meet.
namespace tabor::deposition {

/// Basins of a surface, numbered in the order of their lowest pixels' numbers. With an open edge
/// basin 0 is the ocean, whose bottom is below every pixel.
struct Basins {
  std::vector<Rank> bottoms;         ///< per basin: its lowest pixel
  UnwrittenVector<PoolId> of_pixel;  ///< per pixel: where its steepest descent ends
  /// Pixels, ascending, whose lower neighbours are not connected by lower pixels among the eight
  /// around them: only there can pools meet (the join saddles of Chiang, Lenz, Lu & Rote 2005).
  std::vector<Rank> saddles;
};

Basins find_basins(const Terrain& terrain);

}  // namespace tabor::deposition
