#pragma once

#include <string>

#include "tabor/topography/topography.hpp"

namespace tabor::synthesis {

/// Throws InputError unless the grid has pixels and a positive, finite size.
void check_grid(const Grid& grid, const std::string& what);

/// A generated surface: source and history carry the recipe.
topography::Topography generated(const Grid& grid, Field height, bool periodic,
                                 const std::string& recipe);

}  // namespace tabor::synthesis
