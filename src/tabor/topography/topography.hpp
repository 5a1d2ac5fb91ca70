#pragma once

#include <map>
#include <string>
#include <vector>

#include "tabor/core/types.hpp"

namespace tabor::topography {

/// A measured or generated height map. A value: treatments return new ones.
struct Topography {
  Grid grid;
  Field height;            ///< [m], asperities up, NaN = hole
  bool periodic = false;   ///< true for generated surfaces that tile without a seam
  std::string source;      ///< file name or recipe
  std::string format;      ///< as in `tabor formats`, e.g. "x3p"
  std::string instrument;  ///< as the file names it, "" if it does not
  std::string channel;     ///< title of the channel that was read
  std::map<std::string, std::string> metadata;
  std::vector<std::string> history;  ///< treatment steps so far, canonical text with numbers
  std::vector<std::string> doubts;   ///< what a careful user should know about the file
};

Mask holes(const Topography& topography);  ///< true where height is NaN
Index count_holes(const Topography& topography);

}  // namespace tabor::topography
