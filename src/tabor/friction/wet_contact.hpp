#pragma once

#include "tabor/core/types.hpp"

namespace tabor::friction {

/// Wet contact pixels / contact pixels: how much of the real contact stands in liquid. `contact` is
/// true where the solids touch, `film` the liquid's thickness [m] before they do, same shape. 0 if
/// nothing touches. Throws InputError for different shapes or NaN.
double lubricated_share(const Mask& contact, const Field& film);

/// The share of the liquid that no longer fits when the surfaces close on each other: sum of
/// max(film - gap, 0) over the sum of film (Costagliola et al. 2021, section 4.3). A negative gap
/// (plastic overlap) holds no liquid, as a closed one. 0 without liquid. Throws as above.
double spill_over_fraction(const Field& film, const Field& gap);

}  // namespace tabor::friction
