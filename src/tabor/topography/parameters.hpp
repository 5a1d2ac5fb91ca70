#pragma once

#include <string>
#include <vector>

#include "tabor/topography/topography.hpp"

namespace tabor::topography {

/// A number with everything needed to compare it with another program's.
struct Parameter {
  std::string symbol;      ///< "Sq"
  double value = 0;        ///< SI; NaN where it does not exist (Ssk of a flat surface)
  std::string unit;        ///< "m", "1", "%"
  std::string definition;  ///< formula and convention, one line
};

/// Areal parameters (ISO 25178-2) of the surface AS GIVEN: heights about the mean of its valid
/// points. ISO means them for a levelled surface; level first (`--level plane`).
/// Order: Sa Sq Ssk Sku Sp Sv Sz Sdq Sdr, then N (valid points). Throws InputError if all are
/// holes.
std::vector<Parameter> parameters(const Topography& topography);

/// Sdq: root mean square of the gradient, forward differences on the common (nx-1)(ny-1) grid;
/// cells that touch a hole are left out; a periodic surface uses all nx ny differences. [1]
double rms_slope(const Topography& topography);

/// Sdr [%]: developed over projected area minus one, mean of both splits of each cell into two
/// triangles, over cells without holes.
double developed_area_ratio(const Topography& topography);

/// Sq: root mean square height about the mean of the valid points. [m]
double rms_height(const Topography& topography);

}  // namespace tabor::topography
