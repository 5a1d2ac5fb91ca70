#pragma once

// Names what lies beyond the borders of a map that presses on a half-space.
namespace tabor::elastic {

/// Pressure beyond the borders of a map.
enum class Border {
  repeats,  ///< that of the map, again and again
  mirrors,  ///< that of its mirror images on all sides
  ends      ///< none
};

}  // namespace tabor::elastic
