#pragma once

#include <cstdint>
#include <vector>

#include "tabor/core/convergence.hpp"
#include "tabor/metrology/features/neighbours.hpp"
#include "tabor/topography/topography.hpp"

// Divides a surface into hills or dales by watershed segmentation with Wolf pruning.
namespace tabor::metrology {

/// Kind of a motif: a hill around a peak or a dale around a pit. The dales of z are the hills of
/// -z.
enum class MotifKind { hill, dale };

inline constexpr PixelIndex kNoPixel = 0xFFFFFFFFU;
inline constexpr std::uint32_t kNoMotif = 0xFFFFFFFFU;

/// Hill (or dale) after pruning.
struct Motif {
  PixelIndex extremum = kNoPixel;  ///< the peak (pit); of a plateau its first pixel
  PixelIndex saddle = kNoPixel;  ///< the highest (lowest) pass to a neighbour, kNoPixel without one
  std::uint32_t n_pixels = 0;
  bool closed = true;          ///< no pixel on the edge of the map or beside a hole
  bool inner_extremum = true;  ///< the extremum, plateau or not, has only valid neighbours
  double volume = 0;           ///< [m^3] above (below) the height of the saddle, 0 without one
};

/// Division of a map into hills or into dales.
struct Segmentation {
  std::vector<Motif> motifs;         ///< by falling (dales: rising) extremum
  std::vector<std::uint32_t> label;  ///< per pixel: index of its motif; kNoMotif for holes
};

/// Segments a map by watersheds with Wolf pruning (ISO 25178-2:2021; ISO 16610-85; Wolf 1991). Each
/// pixel belongs to the peak at the end of the steepest path up, among eight neighbours; the pixels
/// of a plateau to that of the shortest path off it. Then, smallest first, every hill whose peak
/// stands less than `least_difference` [m] above its highest saddle becomes part of the hill across
/// it. Two peaks of one plateau are one. An area cut off by holes has a last peak without a saddle,
/// which is measured from the lowest point of its area; if that is too little its pixels have no
/// motif. Wraps round where the map is periodic. At most 20 bytes per pixel with the heights; time
/// n plus m log m for m pixels on borders between unpruned hills. The same for any number of
/// threads. Throws InputError for maps of 2^31 pixels or more; Interrupted when the observer stops
/// it.
Segmentation segment(const topography::Topography& topography, MotifKind kind,
                     double least_difference, const Observer& observer = {});

}  // namespace tabor::metrology
