#pragma once

#include "tabor/deposition/deposition.hpp"
#include "tabor/deposition/pools.hpp"

// Measures a deposited film: its thickness, connected wet regions, wet fraction.
namespace tabor::deposition {

/// Returns the thickness of the liquid in the pools, and of a flood [quanta] above all of them [m].
Field thickness_in(Pools& pools, double flood);

/// Counts the 4-connected regions of thickness > 0; across the borders if periodic.
Index count_wet_regions(const Field& thickness, bool periodic);

/// Fills in n_pools, wet_fraction and max_film of a film whose thickness is known.
void measure(Film& film, Edge edge);

}  // namespace tabor::deposition
