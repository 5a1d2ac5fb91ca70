#pragma once

#include "tabor/deposition/deposition.hpp"

// Measures a deposited film: connected wet regions, wet fraction, largest thickness.
namespace tabor::deposition {

/// Counts the 4-connected regions of thickness > 0; across the borders if periodic.
Index count_wet_regions(const Field& thickness, bool periodic);

/// Fills in n_pools, wet_fraction and max_film of a film whose thickness is known.
void measure(Film& film, Edge edge);

}  // namespace tabor::deposition
