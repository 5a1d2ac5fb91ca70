#pragma once

#include <string>
#include <vector>

#include "tabor/topography/topography.hpp"

namespace tabor::topography {

/// What a careful user should know about these heights, one sentence each: pixels that are not
/// square, holes, quantised heights, spikes, tilt larger than the roughness, sizes that make slow
/// transforms. What only the file can tell (a guessed unit) its reader adds itself.
std::vector<Warning> warnings(const Topography& topography);

/// Asks anew, after a treatment, what it may have changed. Steps of the height and spikes are those
/// of the measurement and stay, the spikes until a step has looked for them.
void renew_warnings(Topography& topography, bool looked_for_spikes);

/// The step [m] all heights are multiples of (up to a common offset); 0 if there is none or if it
/// is below 2^-24 of their range.
double height_quantum(const Field& height);

}  // namespace tabor::topography
