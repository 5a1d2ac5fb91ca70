#pragma once

#include "tabor/core/names.hpp"
#include "tabor/core/types.hpp"

// Says where the material goes that a sliding tool displaces.
namespace tabor::sliding {

/// Fate of displaced material.
enum class Displaced {
  near,     ///< it rises beside the contact it comes from, as far as the gap has space
  uniform,  ///< it rises evenly out of contact, as far as the gap has space (Pullen & Williamson
            ///< 1972)
  lost      ///< it leaves the surface: abrasive wear
};
inline constexpr auto kDisplaced = names<Displaced>("near", "uniform", "lost");

/// Heights that rise, and what of the displaced material they are.
struct Raised {
  Field height;       ///< [m], >= 0, 0 on contact
  double volume = 0;  ///< sum of the displaced material [m]
  double without_space =
      0;            ///< sum that found no space in the gap and rose evenly out of contact [m]
  double lost = 0;  ///< sum that left the surface [m]
};

/// Distributes displaced material on pixels out of contact. `depth` [m] >= 0: what the contact has
/// displaced; `contact` and `gap` [m]: of the contact that did it. near: a Gaussian of deviation
/// `reach` [m] applied to the depth, c times it, at most the gap, with the c at which volumes
/// agree. As nothing rises above the gap, the pressures stay those of a solution. Sums of depth and
/// rise agree to 1e-13. Opposite borders of the map are neighbours. Where everything touches there
/// is no space: all of it is lost. The map of depths becomes that of heights.
Raised raise(Displaced displaced, Field depth, const Mask& contact, const Field& gap,
             const Grid& grid, double reach);

}  // namespace tabor::sliding
