#pragma once

#include "tabor/deposition/deposition.hpp"

// Lays oil on one of the mirror images that a map is made of, and the same on the others.
namespace tabor::deposition {

/// Returns true if the rain of a dose falls on one image alone: the dose says that the map is made
/// of images, it is, and liquid runs downhill and stays.
bool rains_on_one_image(const Field& height, const Dose& dose);

/// Returns the dose for one image: the seams to the others are walls, as nothing crosses them.
Dose dose_of_image(Dose dose);

/// Returns the question for one image: a pixel is asked for where any of its images is.
Wetting of_image(const Wetting& wetting);

/// Makes the film of the whole map from that of its first quarter; `edge` is that of the map.
Film with_images(Film film, Edge edge);

/// Returns the first doses that wet the pixels of the whole map, whose grid this is, from those of
/// its first quarter.
std::vector<std::uint16_t> with_images(const std::vector<std::uint16_t>& of_image, const Grid& grid,
                                       const Wetting& wetting);

}  // namespace tabor::deposition
