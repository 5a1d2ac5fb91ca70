#pragma once

namespace tabor::elastic {

/// Shape of the pressure between the nodes of a profile.
enum class PressureShape {
  uniform,  ///< constant around each node, half way to its neighbours
  linear,   ///< straight from node to node
};

}  // namespace tabor::elastic
