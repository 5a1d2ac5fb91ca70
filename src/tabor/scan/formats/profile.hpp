#pragma once

#include <string>
#include <vector>

#include "tabor/scan/formats/format.hpp"

// Turns a profile with positions into a map of one row.
namespace tabor::scan::format {

/// Heights at even distances along a line.
struct EvenProfile {
  Field heights;             ///< shape (1, n)
  double step = 0;           ///< in the unit of the positions
  std::string warning = {};  ///< "" unless the heights were interpolated
};

/// Returns the heights at even distances. Positions may be off by up to a twentieth of the mean
/// step; beyond, heights are interpolated linearly to as many even places, and the warning says so.
/// Falling positions are read backwards. Throws InputError for fewer than two points, as many
/// positions as heights not given, and positions that neither rise nor fall throughout.
EvenProfile even_profile(const Contents& contents, std::vector<double> positions,
                         std::vector<double> heights);

/// Returns the layer of a profile whose positions are in `unit_x`, heights in `unit_z`; pixels are
/// taken as square. Adds the warning of the profile to `document`.
Layer profile_layer(EvenProfile profile, const std::string& unit_x, const std::string& unit_z,
                    Document& document);

}  // namespace tabor::scan::format
