#pragma once

#include "tabor/cases/slide/slide.hpp"

// Measures a sheet and its contact while a tool slides over it.
namespace tabor::cases {

/// Returns the mean length of the contact along x [pixels].
double mean_patch_length(const Mask& contact);

/// Returns SlideMaps::state of contact pixels under this pressure and these caps [Pa].
ByteMap state_map(const Mask& touching, const Field& pressure, const contact::Caps& caps);

/// Writes Sq, Sa, Sk, Spk and Svk of heights [m] into a record.
void measure(const Field& sheet, SlideRecord& record);

/// Computes the spectra of a sheet along x and y.
SheetSpectra spectra_of_sheet(const topography::Topography& sheet);

}  // namespace tabor::cases
