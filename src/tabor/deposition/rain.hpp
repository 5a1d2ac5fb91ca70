#pragma once

#include <functional>

#include "tabor/deposition/pools.hpp"

// Rains droplets on a tree of pools until each dose is reached.
namespace tabor::deposition {

/// Amount rained so far, in whole numbers.
struct RainState {
  std::int64_t n_droplets = 0;
  Volume dosed = 0;
  std::int64_t n_looks = 0;  ///< of droplets, at places: a measure of work
};

/// Called when a dose is reached; the pools are in the state of that dose.
using DoseReached = std::function<void(std::size_t dose, const RainState& state)>;

/// Rains droplets of `droplet` quanta on random pixels, one after the other, until each of the
/// doses (ascending, in quanta * pixels) is reached or just exceeded. Needs pools with connected
/// ties.
void rain_droplets(Pools& pools, Height droplet, Reading reading, std::uint64_t seed,
                   const std::vector<Volume>& doses, const DoseReached& reached,
                   const Observer& observer);

}  // namespace tabor::deposition
