#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "tabor/core/checks.hpp"
#include "tabor/core/error.hpp"
#include "tabor/core/units.hpp"
#include "tabor/synthesis/random_field.hpp"
#include "tabor/synthesis/recipe_checks.hpp"
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

void check_recipe(const SelfAffine& recipe) {
  check_grid(recipe.grid, "self-affine surface");
  if (!(recipe.hurst > 0 && recipe.hurst <= 1)) {
    throw InputError("Hurst exponent", fmt::format("{}", recipe.hurst), "0 < H <= 1", "");
  }
  if (recipe.rms_height.has_value() == recipe.rms_slope.has_value()) {
    throw InputError("self-affine surface",
                     recipe.rms_height ? "both rms height and rms slope" : "no amplitude",
                     "either the rms height or the rms slope", "");
  }
  check_positive("rms height", recipe.rms_height.value_or(1));
  check_positive("rms slope", recipe.rms_slope.value_or(1));
  check_positive("stretch", recipe.stretch);
}

std::string describe(const SelfAffine& recipe) {
  const auto length = [](double value) { return value > 0 ? format_si(value, "m") : "none"; };
  return fmt::format(
      "generate self-affine: H = {}, {} = {}, roll-off {}, long cutoff {}, short cutoff {}, "
      "stretch {}, {}, seed {}",
      recipe.hurst, recipe.rms_height ? "rms height" : "rms slope",
      recipe.rms_height ? format_si(*recipe.rms_height, "m") : fmt::format("{}", *recipe.rms_slope),
      length(recipe.roll_off_wavelength), length(recipe.long_cutoff_wavelength),
      length(recipe.short_cutoff_wavelength), recipe.stretch,
      recipe.random_amplitudes ? "random amplitudes" : "random phases", recipe.seed);
}

}  // namespace

topography::Topography self_affine(const SelfAffine& recipe) {
  check_recipe(recipe);
  const Corners corners = corners_of(recipe);
  const double unit = 2 * pi / std::max(recipe.grid.lx, recipe.grid.ly);
  auto field = random_field({recipe.grid, recipe.stretch, recipe.random_amplitudes, recipe.seed, 0,
                             [&](double q) { return power_law(q, corners, recipe.hurst, unit); }});
  if (!(field.variance > 0)) {
    throw InputError("self-affine surface", "no wavevector between the cutoffs",
                     "cutoffs between the scan side and two pixels", "");
  }
  const double scale = recipe.rms_height ? *recipe.rms_height / std::sqrt(field.variance)
                                         : *recipe.rms_slope / std::sqrt(field.slope_variance);
  field.height *= scale;
  return generated(recipe.grid, std::move(field.height), true, describe(recipe));
}

topography::Topography ground(const Ground& recipe) {
  check_positive("groove spacing", recipe.groove_spacing);
  check_positive("groove length", recipe.groove_length);
  SelfAffine grooves;
  grooves.grid = recipe.grid;
  grooves.hurst = recipe.hurst;
  grooves.rms_height = recipe.rms_height;
  grooves.roll_off_wavelength = std::sqrt(recipe.groove_spacing * recipe.groove_length);
  grooves.stretch = recipe.groove_length / recipe.groove_spacing;
  grooves.random_amplitudes = true;
  grooves.seed = recipe.seed;
  auto surface = self_affine(grooves);
  const auto text = fmt::format(
      "generate ground: Sq = {}, H = {}, groove spacing {}, length {}, seed {}",
      format_si(recipe.rms_height, "m"), recipe.hurst, format_si(recipe.groove_spacing, "m"),
      format_si(recipe.groove_length, "m"), recipe.seed);
  return generated(recipe.grid, std::move(surface.height), true, text);
}

}  // namespace tabor::synthesis
