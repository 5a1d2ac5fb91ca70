#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "tabor/core/error.hpp"
#include "tabor/core/units.hpp"
#include "tabor/synthesis/random_field.hpp"
#include "tabor/synthesis/recipe_checks.hpp"
#include "tabor/synthesis/recipe_parameters.hpp"
#include "tabor/synthesis/synthesis.hpp"

namespace tabor::synthesis {
namespace {

using std::numbers::pi;

/// Corner wavevectors of the spectrum [rad/m].
struct Corners {
  double lowest = 0;
  double roll_off = 0;
  double highest = std::numeric_limits<double>::infinity();
};

Corners corners_of(const SelfAffine& recipe) {
  const auto wavevector = [](double wavelength, double otherwise) {
    return wavelength > 0 ? 2 * pi / wavelength : otherwise;
  };
  Corners corners;
  // Rounding must not drop the modes that lie exactly on a cutoff.
  corners.lowest = wavevector(recipe.long_cutoff_wavelength, 0) * (1 - 1e-12);
  corners.roll_off = wavevector(recipe.roll_off_wavelength, 0);
  corners.highest =
      wavevector(recipe.short_cutoff_wavelength, std::numeric_limits<double>::infinity()) *
      (1 + 1e-12);
  return corners;
}

double power_law(double q, const Corners& corners, double hurst, double unit) {
  if (q < corners.lowest || q > corners.highest) return 0;
  return std::pow(std::max(q, corners.roll_off) / unit, -2 * (1 + hurst));
}

[[noreturn]] void reject_waves() {
  throw InputError("self-affine surface", "no wavevector between the cutoffs",
                   "cutoffs between the scan side and two pixels", "");
}

void check_recipe(const SelfAffine& recipe) {
  check_grid(recipe.grid, "self-affine surface");
  check_settings(recipe);
  check_height("waves of the rms slope",
               recipe.rms_slope.value_or(0) * std::max(recipe.grid.lx, recipe.grid.ly) / (2 * pi));
}

/// Throws InputError if the cutoffs leave out the longest wave that fits, and all shorter ones, or
/// the shortest wave of the pixels, and all longer ones; or if the spectrum is flat.
void check_waves(const SelfAffine& recipe, const Corners& corners) {
  const Grid& grid = recipe.grid;
  const double longest = std::min(elliptic_wavevector(2 * pi / grid.lx, 0, recipe.stretch),
                                  elliptic_wavevector(0, 2 * pi / grid.ly, recipe.stretch));
  const double shortest = elliptic_wavevector(pi / grid.dx(), pi / grid.dy(), recipe.stretch);
  if (longest > corners.highest || shortest < corners.lowest) reject_waves();
  if (shortest > corners.roll_off) return;
  throw InputError("self-affine surface",
                   "a roll-off wavelength of " + format_si(recipe.roll_off_wavelength, "m"),
                   "more than the shortest wave, " + format_si(2 * pi / shortest, "m"),
                   "take smaller pixels, or the surface is white noise");
}

}  // namespace

topography::Topography self_affine(const SelfAffine& recipe) {
  check_recipe(recipe);
  const Corners corners = corners_of(recipe);
  check_waves(recipe, corners);
  const double unit = 2 * pi / std::max(recipe.grid.lx, recipe.grid.ly);
  auto field = random_field({recipe.grid, recipe.stretch, recipe.random_amplitudes, recipe.seed, 0,
                             [&](double q) { return power_law(q, corners, recipe.hurst, unit); }});
  if (!(field.variance > 0)) reject_waves();
  const double scale = recipe.rms_height ? *recipe.rms_height / std::sqrt(field.variance)
                                         : *recipe.rms_slope / std::sqrt(field.slope_variance);
  field.height *= scale;
  return generated(recipe.grid, std::move(field.height), true, describe(recipe));
}

topography::Topography ground(const Ground& recipe) {
  check_grid(recipe.grid, "ground surface");
  check_settings(recipe);
  check_two_pixels("ground surface", "a groove spacing", recipe.groove_spacing, recipe.grid.dy());
  check_two_pixels("ground surface", "a groove length", recipe.groove_length, recipe.grid.dx());
  SelfAffine grooves;
  grooves.grid = recipe.grid;
  grooves.hurst = recipe.hurst;
  grooves.rms_height = recipe.rms_height;
  grooves.roll_off_wavelength = std::sqrt(recipe.groove_spacing * recipe.groove_length);
  grooves.stretch = recipe.groove_length / recipe.groove_spacing;
  grooves.random_amplitudes = true;
  grooves.seed = recipe.seed;
  auto surface = self_affine(grooves);
  return generated(recipe.grid, std::move(surface.height), true, describe(recipe));
}

}  // namespace tabor::synthesis
