#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "tabor/core/types.hpp"
#include "tabor/deposition/deposition.hpp"

// Rounds a height map to whole numbers, in which the rules of deposition are exact.
namespace tabor::deposition {

using Height = std::int32_t;  ///< of a solid or a level, in quanta above the terrain's datum
using Pixel = std::int32_t;   ///< row * nx + column
using Volume = std::int64_t;  ///< in quanta * pixels

inline constexpr Pixel kOutside = -1;  ///< neighbour of the border pixels of an open edge
inline constexpr Height kDry = std::numeric_limits<Height>::min();    ///< below every height
inline constexpr Height kNoRim = std::numeric_limits<Height>::max();  ///< above every height

/// Dry surface in whole numbers, so that the rule of deposition has no rounding.
struct Terrain {
  Pixel nx = 0;
  Pixel ny = 0;
  Edge edge = Edge::closed;
  std::vector<Height> height;  ///< all within (kDry, kNoRim), shape (ny, nx)
  double quantum = 1;          ///< [m]

  Pixel size() const { return nx * ny; }
};

/// Rounds heights to multiples of the quantum: the smallest power of two of a picometre, not below
/// 1/256 pm, for which the range of heights fits 32 bits. Throws InputError on NaN or infinity.
Terrain quantise(const Field& height, Edge edge);

/// Calls visit(q) for the four neighbours of p that exist; q is kOutside beyond an open edge.
template <class Visit>
void for_each_neighbour(const Terrain& terrain, Pixel p, Visit&& visit) {
  const Pixel nx = terrain.nx;
  const Pixel row = p / nx;
  const Pixel column = p - row * nx;
  const auto step = [&](bool inside, Pixel neighbour, Pixel wrapped) {
    if (inside) {
      visit(neighbour);
    } else if (terrain.edge == Edge::periodic) {
      visit(wrapped);
    } else if (terrain.edge == Edge::open) {
      visit(kOutside);
    }
  };
  const Pixel last_row = (terrain.ny - 1) * nx;
  step(row > 0, p - nx, p + last_row);
  step(column > 0, p - 1, p + nx - 1);
  step(column < nx - 1, p + 1, p - nx + 1);
  step(row < terrain.ny - 1, p + nx, p - last_row);
}

}  // namespace tabor::deposition
