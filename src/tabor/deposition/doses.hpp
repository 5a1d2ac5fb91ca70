#pragma once

#include <vector>

#include "tabor/deposition/deposition.hpp"
#include "tabor/deposition/terrain.hpp"

// Checks the doses of liquid for a surface and makes whole numbers of them.
namespace tabor::deposition {

/// Throws InputError for a surface or a dose that no liquid can be laid on.
void check(const Field& height, const Grid& grid, const Dose& dose);

/// Throws InputError where no first of the doses that wets a pixel can be found.
void check(const Grid& grid, const Dose& dose, const Wetting& wetting);

/// Returns the volumes of mean films [m] on `n_pixels` pixels [quanta]. Throws InputError where one
/// is more than whole numbers can hold on all pixels.
std::vector<Volume> volumes(const std::vector<double>& mean_films, const Terrain& terrain,
                            Pixel n_pixels);

}  // namespace tabor::deposition
