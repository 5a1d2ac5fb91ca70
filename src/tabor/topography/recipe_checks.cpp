#include "tabor/topography/recipe_checks.hpp"

#include <fmt/format.h>

#include <cmath>

#include "tabor/core/error.hpp"

namespace tabor::topography {

void check_grid(const Grid& grid, const std::string& what) {
  if (grid.nx < 1 || grid.ny < 1) {
    throw InputError(what, fmt::format("{} x {} pixels", grid.nx, grid.ny), "at least one pixel",
                     "");
  }
  check_positive(grid.lx, what + ": size along x");
  check_positive(grid.ly, what + ": size along y");
}

void check_positive(double value, const std::string& what) {
  if (!(value > 0) || !std::isfinite(value)) {
    throw InputError(what, fmt::format("{}", value), "a positive number", "");
  }
}

Topography generated(const Grid& grid, Field height, bool periodic, const std::string& recipe) {
  Topography topography;
  topography.grid = grid;
  topography.height = std::move(height);
  topography.periodic = periodic;
  topography.source = recipe;
  topography.channel = "height";
  topography.history.push_back(recipe);
  return topography;
}

}  // namespace tabor::topography
