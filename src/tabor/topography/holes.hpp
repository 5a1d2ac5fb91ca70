#pragma once

#include <optional>
#include <string_view>

#include "tabor/core/convergence.hpp"
#include "tabor/topography/topography.hpp"

// Fills missing heights by one of three methods.
namespace tabor::topography {

/// Method by which missing heights are replaced.
/// harmonic: the discrete Laplace equation in each hole, measured heights on its rim, no slope
/// across the edge of the scan (a soap film: no new extrema). nearest: the nearest valid pixel by
/// distance. mean: the mean of all valid heights.
enum class Fill { harmonic, nearest, mean };

/// Returns the method of a name, "harmonic" and so on; nullopt if there is none.
std::optional<Fill> fill_from(std::string_view name);
/// Returns the name of a method.
std::string_view name_of(Fill fill);

/// Filled map, and how it was filled.
struct FillResult {
  Field height;             ///< without holes
  Index n_filled = 0;       ///< pixels that were holes
  Index n_holes = 0;        ///< connected holes (4 neighbours; counted for harmonic only)
  Index largest = 0;        ///< pixels of the largest hole (harmonic only)
  Convergence convergence;  ///< certificate: residual relative to the height range (harmonic only)
};

/// Fills the holes of a height field. Throws InputError when every pixel is a hole.
FillResult fill_holes(const Field& height, const Grid& grid, Fill fill,
                      const Observer& observer = {});

/// Returns the topography without holes, with a line in the history that says how much was filled.
Topography fill_holes(Topography topography, Fill fill, const Observer& observer = {});

}  // namespace tabor::topography
