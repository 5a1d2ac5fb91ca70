#pragma once

#include <vector>

#include "tabor/core/types.hpp"

// Finds how much liquid is trapped in closed regions of the gap of a contact.
namespace tabor::friction {

/// Connected region of the open gap (4 neighbours, no contact pixel in it) that holds liquid.
struct GapRegion {
  Index n_pixels = 0;
  Index first_pixel = 0;     ///< lowest row-major index, to find it again on the map
  double liquid_volume = 0;  ///< [m^3]
  double gap_volume = 0;     ///< volume between the surfaces [m^3]
  bool trapped = false;      ///< no path out through the gap
};

/// Shares of the liquid when the surfaces are closed. The three shares add up to 1 (to 0 without
/// liquid).
struct TrappedLiquid {
  std::vector<GapRegion> regions;  ///< those with liquid, in the order of first_pixel
  double trapped_fraction = 0;     ///< of the liquid: in regions without a path out
  double escaping_fraction = 0;  ///< in regions that reach the edge, or run through a periodic cell
  double under_contact_fraction = 0;  ///< on pixels where the solids touch: squeezed out first
};

/// Labels the gap of a closed contact. A region lets liquid out if it reaches the border of the
/// map; in a periodic cell there is no border: there it must connect a point with its own periodic
/// image. `film` and `gap` [m], all of shape (grid.ny, grid.nx). Throws InputError for other shapes
/// or NaN.
TrappedLiquid trapped_liquid(const Mask& contact, const Field& film, const Field& gap,
                             const Grid& grid, bool periodic);

}  // namespace tabor::friction
