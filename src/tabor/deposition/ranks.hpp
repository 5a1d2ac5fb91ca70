#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "tabor/deposition/terrain.hpp"

// Puts pixels in one order: by height, equal heights by pixel number.
namespace tabor::deposition {

/// Place of a pixel in the order in which liquid with ordered ties reaches all of them: the height
/// above, the pixel number below.
using Rank = std::uint64_t;

inline constexpr Rank kOceanRank = 0;  ///< of what lies beyond an open edge: below all pixels

inline Rank rank_of(Height height, Pixel p) {
  return (Rank{static_cast<std::uint32_t>(height) ^ 0x80000000U} << 32) |
         static_cast<std::uint32_t>(p);
}
inline Pixel pixel_of(Rank rank) { return static_cast<Pixel>(rank & 0xFFFFFFFFU); }
inline Height height_of(Rank rank) {
  return static_cast<Height>(static_cast<std::uint32_t>(rank >> 32) ^ 0x80000000U);
}

/// Ranks or heights of which there are no more are sorted by comparing them; more, by their digits
/// on all threads, which needs as much memory again.
inline constexpr std::size_t kFewRanks = 1 << 15;

/// Sorts ranks whose pixel numbers ascend.
void sort_by_height(std::vector<Rank>& ranks);

/// Sorts heights.
void sort_heights(std::span<Height> heights);

/// Returns all pixels in their order; needs 16 bytes per pixel meanwhile.
std::vector<Pixel> ascending_pixels(const Terrain& terrain);

}  // namespace tabor::deposition
