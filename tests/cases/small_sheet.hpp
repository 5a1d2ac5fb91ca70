#pragma once

#include "tabor/cases/settings.hpp"
#include "tabor/synthesis/synthesis.hpp"

// A small rough sheet of aluminium for tests of cases.
namespace tabor::test {

inline topography::Topography small_sheet() {
  synthesis::SelfAffine recipe;
  recipe.grid = {64, 48, 64e-6, 48e-6};
  recipe.rms_height = 0.5e-6;
  return synthesis::self_affine(recipe);
}

inline cases::ContactSettings aluminium() {
  return {.youngs_modulus = 70e9, .poissons_ratio = 0.33, .saturation_pressure = 240e6};
}

/// Each setting under its own name.
inline std::string own_name(std::string_view setting) { return std::string(setting); }

}  // namespace tabor::test
