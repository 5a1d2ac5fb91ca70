#pragma once

#include <vector>

#include "tabor/metrology/features/neighbours.hpp"
#include "tabor/metrology/features/watershed.hpp"

// Follows the steepest path up from every pixel to the peak where it ends.
namespace tabor::metrology {

/// Upper limit of the number of pixels, so that a number and a pixel can share 32 bits.
inline constexpr PixelIndex kPixelLimit = 0x80000000U;

/// Heights with the sign of the segmentation: dales are hills of -z.
struct Relief {
  const topography::Topography& map;
  Neighbours neighbours;
  double sign;

  Relief(const topography::Topography& topography, MotifKind kind)
      : map(topography), neighbours(topography), sign(kind == MotifKind::hill ? 1 : -1) {}
  double operator()(PixelIndex p) const { return sign * map.height.data()[p]; }
  PixelIndex n_pixels() const { return static_cast<PixelIndex>(map.height.size()); }
};

/// Peaks at which the steepest paths up from every pixel end.
struct Ascents {
  std::vector<PixelIndex> peaks;     ///< highest first, equal ones by rising pixel
  std::vector<std::uint32_t> label;  ///< per pixel: number of its peak in `peaks`; kNoMotif: hole
};

/// Follows the steepest paths. Pixels of a plateau without a higher neighbour take the shortest
/// path off it, in steps to neighbours; the first pixel of a plateau without such a path is the
/// peak.
Ascents climb(const Relief& relief);

}  // namespace tabor::metrology
