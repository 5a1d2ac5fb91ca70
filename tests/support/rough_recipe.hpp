#pragma once

#include "tabor/synthesis/synthesis.hpp"

namespace tabor::test {

/// A self-affine surface of n * n pixels of 1 um, 1 um rms height and Gaussian amplitudes.
inline synthesis::SelfAffine rough_recipe(Index n, double hurst, std::uint64_t seed = 1) {
  synthesis::SelfAffine recipe;
  const double side = static_cast<double>(n) * 1e-6;
  recipe.grid = {n, n, side, side};
  recipe.hurst = hurst;
  recipe.rms_height = 1e-6;
  recipe.random_amplitudes = true;
  recipe.seed = seed;
  return recipe;
}

}  // namespace tabor::test
