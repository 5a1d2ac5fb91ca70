#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "tabor/core/checks.hpp"
#include "tabor/core/error.hpp"
#include "tabor/core/rows.hpp"
#include "tabor/core/units.hpp"
#include "tabor/synthesis/recipe_checks.hpp"
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

/// Shorter waves show as longer ones, or not at all.
void check_two_pixels(double wavelength, double pixel) {
  if (wavelength > 0 && wavelength < 2 * pixel * (1 - 1e-9)) {
    throw InputError("sinusoid", "a wavelength of " + format_si(wavelength, "m"),
                     fmt::format("at least two pixels ({})", format_si(2 * pixel, "m")),
                     "take smaller pixels");
  }
}

std::string wavelength_text(double wavelength, char axis) {
  return wavelength > 0 ? fmt::format("{} along {}", format_si(wavelength, "m"), axis)
                        : fmt::format("none along {}", axis);
}

}  // namespace

topography::Topography sinusoid(const Sinusoid& recipe) {
  check_grid(recipe.grid, "sinusoid");
  if (recipe.wavelength_x < 0 || recipe.wavelength_y < 0 ||
      !(recipe.wavelength_x + recipe.wavelength_y > 0)) {
    throw InputError(
        "sinusoid",
        fmt::format("wavelengths {} m and {} m", recipe.wavelength_x, recipe.wavelength_y),
        "at least one positive wavelength, none negative", "");
  }
  check_two_pixels(recipe.wavelength_x, recipe.grid.dx());
  check_two_pixels(recipe.wavelength_y, recipe.grid.dy());
  const double qx = recipe.wavelength_x > 0 ? 2 * pi / recipe.wavelength_x : 0;
  const double qy = recipe.wavelength_y > 0 ? 2 * pi / recipe.wavelength_y : 0;
  auto height = sample(recipe.grid, false, [&](double x, double y) {
    return recipe.amplitude * std::cos(qx * x) * std::cos(qy * y);
  });
  const bool periodic =
      fits(recipe.grid.lx, recipe.wavelength_x) && fits(recipe.grid.ly, recipe.wavelength_y);
  return generated(
      recipe.grid, std::move(height), periodic,
      fmt::format("generate sinusoid: amplitude {}, wavelengths {} and {}",
                  format_si(recipe.amplitude, "m"), wavelength_text(recipe.wavelength_x, 'x'),
                  wavelength_text(recipe.wavelength_y, 'y')));
}

topography::Topography sphere(const Sphere& recipe) {
  check_grid(recipe.grid, "sphere");
  check_positive("radius of the sphere", recipe.radius);
  const double radius = recipe.radius;
  auto height = sample(recipe.grid, true, [radius](double x, double y) {
    const double square = x * x + y * y;
    // sqrt(R^2 - r^2) - R without cancellation near the pole
    return square < radius * radius ? -square / (radius + std::sqrt(radius * radius - square))
                                    : -radius;
  });
  return generated(recipe.grid, std::move(height), false,
                   fmt::format("generate sphere: radius {}", format_si(radius, "m")));
}

topography::Topography bump(const Bump& recipe) {
  check_grid(recipe.grid, "bump");
  check_positive("radius of the bump", recipe.radius);
  auto height = sample(recipe.grid, true, [&](double x, double y) {
    const double r = std::hypot(x, y) / recipe.radius;
    const double c = r < 1 ? std::cos(pi / 2 * r) : 0;
    return recipe.height * c * c;
  });
  const bool inside = 2 * recipe.radius <= std::min(recipe.grid.lx, recipe.grid.ly);
  return generated(recipe.grid, std::move(height), inside,
                   fmt::format("generate bump: height {}, radius {}", format_si(recipe.height, "m"),
                               format_si(recipe.radius, "m")));
}

}  // namespace tabor::synthesis
