#pragma once

#include <cstdint>
#include <vector>

#include "tabor/core/convergence.hpp"
#include "tabor/topography/topography.hpp"

namespace tabor::topography {

/// A pixel as its place in the row-major order of the map.
using PixelIndex = std::uint32_t;

/// Hills stand around peaks, dales around pits. The dales of z are the hills of -z.
enum class MotifKind { hill, dale };

/// One hill (or dale) after pruning. Heights are those of the map, never negated.
struct Motif {
  PixelIndex extremum = 0;     ///< the highest (lowest) pixel; of a plateau the first one
  double extremum_height = 0;  ///< [m]
  /// The highest pass to a neighbouring hill (lowest to a dale); NaN if there is no neighbour. [m]
  double saddle_height = 0;
  Index n_pixels = 0;
  double volume = 0;           ///< [m^3] between the surface and the level of saddle_height
  bool closed = true;          ///< no pixel on the edge of the map or beside a hole
  bool inner_extremum = true;  ///< all eight neighbours of `extremum` exist
};

inline constexpr std::uint32_t kNoMotif = 0xFFFFFFFFU;

/// The map cut into hills or into dales. A hole belongs to none.
struct Segmentation {
  MotifKind kind = MotifKind::hill;
  double least_difference = 0;       ///< [m] of the pruning
  std::vector<Motif> motifs;         ///< by falling (dales: rising) extremum
  std::vector<std::uint32_t> label;  ///< per pixel: index of its motif, or kNoMotif
};

/// Valid pixels by rising height, equal heights by rising pixel. 4 bytes per pixel; 12 while it is
/// made. Throws InputError for maps of 2^32 - 1 pixels or more.
std::vector<PixelIndex> height_order(const Field& height);

/// Watershed segmentation and Wolf pruning (ISO 25178-2:2021 and ISO 16610-85; Wolf 1991). Each
/// pixel belongs to the peak that the steepest way up leads to, among eight neighbours; the pixels
/// of a plateau to the nearest way off it. Then, smallest first, every hill whose peak stands less
/// than `least_difference` above its highest saddle becomes part of the hill across that saddle.
/// The highest peak of an area cut off by holes has no saddle: it stands above the lowest point of
/// its area, and if it stands too low it is no motif (its pixels have none). Two peaks of one
/// plateau never count twice. Wraps round where the map is periodic.
/// 16 bytes per pixel with the heights (20 in a plateau of the whole map), time n log n, serial.
/// Throws Interrupted when the observer stops it.
Segmentation segment(const Topography& topography, MotifKind kind, double least_difference,
                     const Observer& observer = {});

/// The same with the order at hand, for hills and dales of one map.
Segmentation segment(const Topography& topography, MotifKind kind, double least_difference,
                     const std::vector<PixelIndex>& order, const Observer& observer = {});

}  // namespace tabor::topography
