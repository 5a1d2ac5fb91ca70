#pragma once

#include <functional>

#include "tabor/deposition/pools.hpp"

namespace tabor::deposition {

/// What has been rained so far, in whole numbers.
struct RainState {
  std::int64_t n_droplets = 0;
  Volume dosed = 0;
};

/// Told when a dose is reached; the pools are as they stand then.
using DoseReached = std::function<void(std::size_t dose, const RainState& state)>;

/// Rains droplets of `droplet` quanta on one random pixel after the other until each of the doses
/// (ascending, in quanta * pixels) is reached or just exceeded. Pools with connected ties.
void rain_droplets(Pools& pools, Height droplet, Reading reading, std::uint64_t seed,
                   const std::vector<Volume>& doses, const DoseReached& reached,
                   const Observer& observer);

/// The same for vanishing droplets, each pixel receiving the same: fill, spill, merge (Barnes,
/// Callaghan & Wickert 2020, doi:10.5194/esurf-8-431-2020). Doses are films (ascending, in quanta).
/// Pools with ordered ties. What a pool receives comes from the catchment its dry valleys drain.
void rain_evenly(Pools& pools, const std::vector<Volume>& films, const DoseReached& reached,
                 const Observer& observer);

}  // namespace tabor::deposition
