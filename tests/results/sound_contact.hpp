#pragma once

#include <string>
#include <vector>

#include "tabor/cases/warnings.hpp"
#include "tabor/synthesis/synthesis.hpp"

// Makes a surface and a contact that have no warnings.
namespace tabor::results {

inline const Grid kGrid{64, 48, 64e-6, 48e-6};

inline topography::Topography rough(double rms_slope = 0.1) {
  synthesis::SelfAffine recipe;
  recipe.grid = kGrid;
  recipe.rms_slope = rms_slope;
  return synthesis::self_affine(recipe);
}

/// A contact that nothing is to be said about: a disc in the middle.
struct Contact {
  Contact() {
    state.pressure = Field::Zero(kGrid.ny, kGrid.nx);
    state.pressure.block(20, 28, 8, 8) = 1e9;
    state.convergence = {.certificate = 1e-7, .tolerance = 1e-6, .status = Status::converged};
    summary.contact_area_fraction_pixels = 64.0 / static_cast<double>(kGrid.size());
    summary.max_pressure = 1e9;
    summary.n_patches = 1;
  }
  std::vector<std::string> codes() const {
    return codes_of(cases::of_contact(surface, settings, state, summary));
  }
  topography::Topography surface = rough();
  cases::ContactSettings settings{.youngs_modulus = 1e11};
  contact::State state;
  contact::Summary summary;
};

}  // namespace tabor::results
