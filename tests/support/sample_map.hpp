#pragma once

#include <cmath>
#include <limits>

#include "tabor/topography/topography.hpp"

namespace tabor::test {

inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// A small map with holes in a corner and inside, irrational heights and pixels that are not
/// square.
inline topography::Topography small_map() {
  topography::Topography map;
  map.grid = {.nx = 5, .ny = 4, .lx = 5 * 0.67e-6, .ly = 4 * 1.1e-6};
  map.height = Field(4, 5);
  for (Index i = 0; i < 20; ++i) {
    map.height.data()[i] = 1e-6 * std::sin(1.0 + static_cast<double>(i * i));
  }
  map.height(0, 0) = kNaN;
  map.height(2, 3) = kNaN;
  map.channel = "surface";
  map.source = "made in a test";
  return map;
}

}  // namespace tabor::test
