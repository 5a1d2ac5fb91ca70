#pragma once

#include <gtest/gtest.h>

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

/// Expects the work of a step to lie between its bounds, but for rounding.
inline void expect_within_bounds(const Ploughing& step, double mean_pressure) {
  const double rounding = 1e-6 * mean_pressure * step.distance;
  EXPECT_LE(step.lower, step.work + rounding);
  EXPECT_LE(step.work, step.upper + rounding);
}

/// Expects a slider that goes on from what another has reached to find the same bits.
inline void expect_to_go_on(const Rough& rough) {
  Slider whole(*rough.elasticity, rough.problem);
  whole.press();
  whole.advance(2);
  Slider second(*rough.elasticity, rough.problem);
  second.go_on_from(whole.reached());
  const Ploughing expected = whole.advance(2);
  const Ploughing found = second.advance(2);
  EXPECT_EQ(found.work, expected.work);
  EXPECT_EQ(found.lower, expected.lower);
  EXPECT_TRUE((second.sheet() == whole.sheet()).all());
  EXPECT_EQ(second.caps_map().size(), whole.caps_map().size());
  EXPECT_TRUE((second.caps_map() == whole.caps_map()).all());
}

}  // namespace tabor::sliding
