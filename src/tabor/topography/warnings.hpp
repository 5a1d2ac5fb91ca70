#pragma once

#include "tabor/topography/topography.hpp"

// Finds problems in the heights of a surface and warns of them: holes, spikes, tilt, quantised
// heights, jumping rows.
namespace tabor::topography {

/// Returns warnings about these heights, one sentence each: pixels that are not square, holes,
/// quantised heights, spikes, tilt larger than the roughness, rows that jump. The reader of the
/// file adds those that only the file can give (a guessed unit).
Warnings warnings(const Topography& topography);

/// Inspects new heights: stores whether edges match, adds the warnings.
void look_at(Topography& topography);

/// Renews the warnings that a treatment may have changed. Those about quantised heights and spikes
/// belong to the measurement and stay; remove_spikes() ends the warnings about spikes.
void renew_warnings(Topography& topography);

/// Renews the warning about spikes, if there is one, for a part of a surface. A filter hides spikes
/// without removing them: after one the warning stays.
void renew_spikes(Topography& topography);

/// Returns the step [m] of which all heights are multiples (up to a common offset); 0 if there is
/// none or if it is below 2^-24 of their range.
double height_quantum(const Field& height);

}  // namespace tabor::topography
