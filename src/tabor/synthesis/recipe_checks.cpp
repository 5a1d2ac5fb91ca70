#include "tabor/synthesis/recipe_checks.hpp"

#include <fmt/format.h>

#include <cmath>

#include "tabor/core/checks.hpp"
#include "tabor/core/error.hpp"
#include "tabor/core/units.hpp"
#include "tabor/topography/edges.hpp"

namespace tabor::synthesis {

namespace {

/// Limits of a pixel and of heights, as scan files are read [m].
constexpr double kSmallestPixel = 1e-15;
constexpr double kLargest = 1e6;
constexpr double kBytesOfPixel = 16;  // a height, and its share of a transform

}  // namespace

void check_grid(const Grid& grid, const std::string& what) {
  if (grid.nx < 1 || grid.ny < 1) {
    throw InputError(what, fmt::format("{} x {} pixels", grid.nx, grid.ny), "at least one pixel",
                     "");
  }
  check_positive(what + ": size along x", grid.lx);
  check_positive(what + ": size along y", grid.ly);
  for (const double pixel : {grid.dx(), grid.dy()}) {
    if (pixel >= kSmallestPixel * (1 - 1e-9) && pixel <= kLargest * (1 + 1e-9)) continue;
    throw InputError(what, fmt::format("pixels of {:.3g} m", pixel), "from 1e-15 m to 1000 km", "");
  }
  check_memory(what, fmt::format("{} x {} pixels", grid.nx, grid.ny),
               kBytesOfPixel * static_cast<double>(grid.nx) * static_cast<double>(grid.ny),
               "take fewer pixels");
}

void check_height(const std::string& what, double height) {
  if (std::abs(height) <= kLargest) return;
  throw InputError(what, fmt::format("{:.3g} m", height), "a finite height of at most 1000 km", "");
}

void check_two_pixels(const std::string& kind, const std::string& feature, double length,
                      double pixel) {
  if (length >= 2 * pixel * (1 - 1e-9)) return;
  throw InputError(kind, fmt::format("{} of {}", feature, format_si(length, "m")),
                   fmt::format("at least two pixels ({})", format_si(2 * pixel, "m")),
                   "take smaller pixels");
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
  topography::look_at_edges(topography);
  return topography;
}

}  // namespace tabor::synthesis
