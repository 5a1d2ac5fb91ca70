#pragma once

#include <cstdint>

#include "tabor/core/types.hpp"

namespace tabor::synthesis {

inline constexpr double kSmallestCrater = 50e-6;  ///< diameter [m]
inline constexpr double kLargestCrater = 150e-6;  ///< the same

/// Marks of sparks that struck one after the other, [typical depth]: overlapping craters of 50 to
/// 150 um, lengthened along x by rolling, with raised rims, their total area twice the map's.
/// Periodic. Depends on the seed and the lengths of the grid.
Field craters(const Grid& grid, std::uint64_t seed);

}  // namespace tabor::synthesis
