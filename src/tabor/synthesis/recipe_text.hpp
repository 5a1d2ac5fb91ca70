#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "tabor/synthesis/recipes.hpp"

// Reads the recipe of a rough surface from one line: "ground:Sa=0.1um,groove-length=400um,seed=2".
namespace tabor::synthesis {

/// A recipe without its pixels.
struct LineRecipe {
  Request request;                        ///< but for the grid
  std::optional<double> mean_abs_height;  ///< Sa [m], exact, in place of an rms height
  std::optional<double> length;           ///< along x [m]
};

/// True where the text begins with the name of a rough surface, alone or before a colon.
bool is_recipe(std::string_view text);

/// Reads a recipe. Its numbers are the settings of `tabor generate` with their units, and Sa, Sq,
/// H, length and seed. Throws InputError for other kinds, unknown or repeated names, values out of
/// range and numbers without their unit.
LineRecipe parse_recipe(std::string_view text);

/// Generates the surface with these pixels; the grid is as long as the recipe says, in whole
/// pixels.
topography::Topography generate(const LineRecipe& recipe, const Grid& pixels);

}  // namespace tabor::synthesis
