#include "tabor/synthesis/recipe_checks.hpp"

#include <fmt/format.h>

#include <cmath>

#include "tabor/core/checks.hpp"
#include "tabor/core/error.hpp"

namespace tabor::synthesis {

void check_grid(const Grid& grid, const std::string& what) {
  if (grid.nx < 1 || grid.ny < 1) {
    throw InputError(what, fmt::format("{} x {} pixels", grid.nx, grid.ny), "at least one pixel",
                     "");
  }
  check_positive(what + ": size along x", grid.lx);
  check_positive(what + ": size along y", grid.ly);
}

topography::Topography generated(const Grid& grid, Field height, bool periodic,
                                 const std::string& recipe) {
  topography::Topography topography;
  topography.grid = grid;
  topography.height = std::move(height);
  topography.periodic = periodic;
  topography.source = recipe;
  topography.channel = "height";
  topography.history.push_back(recipe);
  return topography;
}

}  // namespace tabor::synthesis
