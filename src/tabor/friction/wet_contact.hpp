#pragma once

#include "tabor/core/types.hpp"

// Finds the wet part and computes the wet share of the real contact, and the share of the oil that
// no longer fits into the gap.
namespace tabor::friction {

/// Returns the contact pixels that are wet. `contact` is true where the solids touch, `film` the
/// liquid's thickness [m] before they do, same shape; a film no thicker than `dry_below` [m] does
/// not wet. Throws InputError for different shapes.
Mask wet_contact(const Mask& contact, const Field& film, double dry_below = 0);

/// Returns wet contact pixels / contact pixels, the wet share of the real contact, of the same.
/// 0 if nothing touches. Throws InputError for different shapes or NaN.
double lubricated_share(const Mask& contact, const Field& film, double dry_below = 0);

/// Returns the share of the liquid that no longer fits when the surfaces close on each other: sum
/// of max(film - gap, 0) over the sum of film (Costagliola et al. 2021, section 4.3). A negative
/// gap (plastic overlap) holds no liquid, as a closed one. 0 without liquid. Throws as above.
double spill_over_fraction(const Field& film, const Field& gap);

}  // namespace tabor::friction
