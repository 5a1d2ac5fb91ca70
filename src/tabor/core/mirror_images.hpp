#pragma once

#include "tabor/core/types.hpp"

// Makes a map that repeats from one that does not.
namespace tabor {

/// Returns 2 x 2 mirror images of a map, row by row: the map itself is the first quarter.
template <typename Map>
Map mirror_images(const Map& map) {
  Map all(2 * map.rows(), 2 * map.cols());
  all << map, map.rowwise().reverse(), map.colwise().reverse(), map.reverse();
  return all;
}

}  // namespace tabor
