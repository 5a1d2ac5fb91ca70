#include "tabor/topography/topography.hpp"

namespace tabor::topography {

std::vector<std::string> texts(const std::vector<Doubt>& doubts) {
  std::vector<std::string> list;
  list.reserve(doubts.size());
  for (const Doubt& doubt : doubts) list.push_back(doubt.text);
  return list;
}

bool is_profile(const Grid& grid) { return grid.nx == 1 || grid.ny == 1; }

Mask holes(const Topography& topography) { return topography.height.isNaN(); }

Index count_holes(const Topography& topography) { return topography.height.isNaN().count(); }

}  // namespace tabor::topography
