#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

// Names treatment chains that kinds of surfaces usually need.
namespace tabor::topography {

/// Named chain that a kind of surface usually needs; it stands for its steps and for nothing else.
struct Recipe {
  std::string name;
  std::string purpose;             ///< which surfaces it is for, and why these steps
  std::vector<std::string> steps;  ///< as a treatment chain has them (treatment.hpp)
};
std::vector<Recipe> recipes();

/// Returns the recipe of a name, or nullopt if there is none.
std::optional<Recipe> recipe_of(std::string_view name);

/// Returns the names of all recipes.
std::vector<std::string> recipe_names();

/// Returns all recipes in one line of help, with steps as options: "sheet = despike auto, ...".
std::string recipe_steps();

}  // namespace tabor::topography
