#pragma once

#include <cstdint>
#include <vector>

#include "tabor/deposition/rain.hpp"

// Rains vanishing droplets, the same on each pixel: fill, spill, merge (Barnes, Callaghan & Wickert
// 2020, doi:10.5194/esurf-8-431-2020). All of it needs pools with ordered ties.
namespace tabor::deposition {

/// Pixels, and rising doses of which one wets each of them first.
struct FirstWetting {
  std::vector<Volume> films;          ///< [quanta]
  const Mask& where;                  ///< shape (ny, nx); empty for all
  std::vector<std::uint16_t>& first;  ///< per pixel, row by row: its dose; films.size() where none
};

/// Rains until each of the doses is reached: films (ascending, in quanta). A pool receives the rain
/// of its catchment.
void rain_evenly(Pools& pools, const std::vector<Volume>& films, const DoseReached& reached,
                 const Observer& observer);

/// Finds in the same run which dose wets a pixel first. The pools must list pixels.
void rain_evenly(Pools& pools, const std::vector<Volume>& films, const DoseReached& reached,
                 const FirstWetting& wetting, const Observer& observer);

}  // namespace tabor::deposition
