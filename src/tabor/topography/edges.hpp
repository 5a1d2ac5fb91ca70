#pragma once

#include "tabor/core/names.hpp"
#include "tabor/topography/topography.hpp"

// Decides whether a surface repeats, from what the user says and from its opposite edges.
namespace tabor::topography {

inline constexpr auto kEdges = names<Edges>("tile", "cut", "end");

/// True where opposite edges continue each other: steps and kinks across the seams are not larger
/// than those between neighbouring lines inside. True of tiles and of maps that are rough from
/// pixel to pixel; false where there are too few heights to decide. A dome has edges of one height,
/// but a kink.
bool edges_match(const Field& height);

/// Stores whether the edges match. An earlier match stays, as levelling tilts a tile; so do edges
/// that a filter has joined.
void look_at_edges(Topography& topography);

/// True where the surface repeats: it is known to, the user says so, or its edges match.
bool repeats(const Topography& topography);

/// True where the heights as they are repeat without a step: transforms may rely on that.
bool tiles_as_it_is(const Topography& topography);

/// Returns the surface with what the user says about its edges; a cut-out is continued by its
/// mirror images. Throws InputError where that contradicts what is known of the surface.
Topography with_edges(Topography topography, Edges edges);

}  // namespace tabor::topography
