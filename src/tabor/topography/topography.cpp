#include "tabor/topography/topography.hpp"

namespace tabor::topography {

Mask holes(const Topography& topography) { return topography.height.isNaN(); }

Index count_holes(const Topography& topography) { return topography.height.isNaN().count(); }

}  // namespace tabor::topography
