#pragma once

#include "tabor/deposition/deposition.hpp"

// Lays oil on one of the mirror images that a map is made of, and the same on the others.
namespace tabor::deposition {

/// Returns true if the rain of a dose falls on one image alone: the dose says that the map is made
/// of images, it is, and liquid runs downhill and stays.
bool rains_on_one_image(const Field& height, const Dose& dose);

/// Returns the dose for one image: the seams to the others are walls, as nothing crosses them.
Dose dose_of_image(Dose dose);

/// Makes the film of the whole map from that of its first quarter; `edge` is that of the map.
Film with_images(Film film, Edge edge);

}  // namespace tabor::deposition
