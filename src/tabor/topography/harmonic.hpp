#pragma once

#include "tabor/core/convergence.hpp"
#include "tabor/core/types.hpp"

// Fills holes by solving Laplace's equation.
namespace tabor::topography {

/// Result of the harmonic fill; sizes in pixels.
struct HarmonicFill {
  Index n_filled = 0;
  Index n_holes = 0;  ///< connected by 4 neighbours
  Index largest = 0;
  Convergence convergence;  ///< certificate: largest residual over the range of valid heights
};

/// Replaces every NaN of `height` by the solution of the five-point Laplace equation (finite
/// volumes, so that pixels need not be square), the valid heights given, no flux across the scan's
/// edge. Conjugate gradients with an aggregation multigrid preconditioner; time and memory grow
/// with the number of missing pixels. At least one height must be valid.
HarmonicFill fill_harmonic(Field& height, const Grid& grid, const Observer& observer = {});

}  // namespace tabor::topography
