#pragma once

#include <memory>

#include "tabor/elastic/half_space.hpp"
#include "tabor/sliding/slider.hpp"
#include "tabor/synthesis/synthesis.hpp"

// A small rough sheet and tool that tests of sliding share.
namespace tabor::sliding {

inline constexpr double kCap = 240e6;
inline constexpr double kPixel = 1e-6;

/// A rough sheet under a rough tool.
struct Rough {
  explicit Rough(Displaced displaced = Displaced::near, double pressure = 10e6)
      : grid{64, 48, 64 * kPixel, 48 * kPixel},
        elasticity(elastic::make_periodic(grid, 78e9)),
        problem{.sheet = surface(0.5e-6, 1),
                .tool = surface(0.1e-6, 2),
                .mean_pressure = pressure,
                .saturation_pressure = kCap,
                .displaced = displaced,
                .tolerance = 1e-8} {}

  Field surface(double rms, std::uint64_t seed) const {
    synthesis::SelfAffine recipe;
    recipe.grid = grid;
    recipe.rms_height = rms;
    recipe.short_cutoff_wavelength = 4 * kPixel;
    recipe.seed = seed;
    return synthesis::self_affine(recipe).height;
  }

  Grid grid;
  std::unique_ptr<elastic::ElasticOperator> elasticity;
  Problem problem;
};

}  // namespace tabor::sliding
