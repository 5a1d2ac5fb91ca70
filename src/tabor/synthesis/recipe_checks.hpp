#pragma once

#include <string>

#include "tabor/topography/topography.hpp"

// Checks the numbers of recipes that no table of parameters can check.
namespace tabor::synthesis {

/// Throws InputError unless the grid has pixels, each of a positive, finite size that a scan may
/// have, and memory is free for their heights and the transform of these.
void check_grid(const Grid& grid, const std::string& what);

/// Throws InputError unless the height [m] is one that a scan may have.
void check_height(const std::string& what, double height);

/// Throws InputError for a feature of `kind`, such as "a wavelength", that is shorter than two
/// pixels [m]: it shows as a longer one, or not at all.
void check_two_pixels(const std::string& kind, const std::string& feature, double length,
                      double pixel);

/// A generated surface: source and history carry the recipe.
topography::Topography generated(const Grid& grid, Field height, bool periodic,
                                 const std::string& recipe);

}  // namespace tabor::synthesis
