#pragma once

#include "tabor/core/large_pages.hpp"
#include "tabor/core/rows.hpp"
#include "tabor/core/types.hpp"

// Makes a map that repeats from one that does not, and finds the one it was made from.
namespace tabor {

/// Returns 2 x 2 mirror images of a map, row by row: the map itself is the first quarter.
template <typename Map>
Map mirror_images(const Map& map) {
  const Index ny = map.rows();
  const Index nx = map.cols();
  Map all = uninitialised_map<Map>(2 * ny, 2 * nx);
  for_each_row(2 * ny, [&](Index y) {
    const auto row = map.row(y < ny ? y : 2 * ny - 1 - y);
    all.row(y).head(nx) = row;
    all.row(y).tail(nx) = row.reverse();
  });
  return all;
}

/// Returns true if a map consists of 2 x 2 mirror images that differ by at most `rounding`; NaN is
/// like NaN.
bool consists_of_images(const Field& map, double rounding);

/// Returns the first quarter of a map, of which the others are mirror images.
Field first_image(const Field& map);
Grid grid_of_image(const Grid& grid);

}  // namespace tabor
