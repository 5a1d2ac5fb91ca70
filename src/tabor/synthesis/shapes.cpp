#include <algorithm>
#include <cmath>
#include <numbers>

#include "tabor/core/rows.hpp"
#include "tabor/synthesis/recipe_checks.hpp"
#include "tabor/synthesis/recipe_parameters.hpp"
#include "tabor/synthesis/synthesis.hpp"

namespace tabor::synthesis {
namespace {

using std::numbers::pi;

/// height(x, y) at every pixel centre, with (0, 0) at the pixel (0, 0) or in the middle of the
/// scan.
template <typename Height>
Field sample(const Grid& grid, bool from_middle, const Height& height) {
  Field field(grid.ny, grid.nx);
  const double shift_x = from_middle ? 0.5 * static_cast<double>(grid.nx - 1) : 0;
  const double shift_y = from_middle ? 0.5 * static_cast<double>(grid.ny - 1) : 0;
  for_each_row(grid.ny, [&](Index y) {
    for (Index x = 0; x < grid.nx; ++x) {
      field(y, x) = height((static_cast<double>(x) - shift_x) * grid.dx(),
                           (static_cast<double>(y) - shift_y) * grid.dy());
    }
  });
  return field;
}

bool fits(double length, double wavelength) {
  const double periods = wavelength > 0 ? length / wavelength : 1;
  return std::abs(periods - std::round(periods)) < 1e-9 * periods;
}

void check_wavelength(double wavelength, double pixel) {
  if (wavelength > 0) check_two_pixels("sinusoid", "a wavelength", wavelength, pixel);
}

/// Throws InputError for a body that its pixels do not show.
void check_size(const std::string& body, double radius, const Grid& grid) {
  check_two_pixels(body, "a diameter", 2 * radius, std::max(grid.dx(), grid.dy()));
}

}  // namespace

topography::Topography sinusoid(const Sinusoid& recipe) {
  check_grid(recipe.grid, "sinusoid");
  check_settings(recipe);
  check_wavelength(recipe.wavelength_x, recipe.grid.dx());
  check_wavelength(recipe.wavelength_y, recipe.grid.dy());
  const double qx = recipe.wavelength_x > 0 ? 2 * pi / recipe.wavelength_x : 0;
  const double qy = recipe.wavelength_y > 0 ? 2 * pi / recipe.wavelength_y : 0;
  auto height = sample(recipe.grid, false, [&](double x, double y) {
    return recipe.amplitude * std::cos(qx * x) * std::cos(qy * y);
  });
  const bool periodic =
      fits(recipe.grid.lx, recipe.wavelength_x) && fits(recipe.grid.ly, recipe.wavelength_y);
  return generated(recipe.grid, std::move(height), periodic, describe(recipe));
}

topography::Topography sphere(const Sphere& recipe) {
  check_grid(recipe.grid, "sphere");
  check_settings(recipe);
  check_size("sphere", recipe.radius, recipe.grid);
  const double radius = recipe.radius;
  auto height = sample(recipe.grid, true, [radius](double x, double y) {
    const double square = x * x + y * y;
    // sqrt(R^2 - r^2) - R without cancellation near the pole
    return square < radius * radius ? -square / (radius + std::sqrt(radius * radius - square))
                                    : -radius;
  });
  return generated(recipe.grid, std::move(height), false, describe(recipe));
}

topography::Topography bump(const Bump& recipe) {
  check_grid(recipe.grid, "bump");
  check_settings(recipe);
  check_size("bump", recipe.radius, recipe.grid);
  auto height = sample(recipe.grid, true, [&](double x, double y) {
    const double r = std::hypot(x, y) / recipe.radius;
    const double c = r < 1 ? std::cos(pi / 2 * r) : 0;
    return recipe.height * c * c;
  });
  const bool inside = 2 * recipe.radius <= std::min(recipe.grid.lx, recipe.grid.ly);
  return generated(recipe.grid, std::move(height), inside, describe(recipe));
}

}  // namespace tabor::synthesis
