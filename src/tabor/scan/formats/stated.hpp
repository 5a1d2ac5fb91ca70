#pragma once

#include <map>
#include <string>

#include "tabor/scan/formats/format.hpp"

// Describes the sizes of a picture of heights by the names that Gwyddion gives them.
namespace tabor::scan::format {

/// Remarks of a picture by their keywords: XReal, YReal, XYUnit, ZUnit, ZMin, ZMax, Title.
using Remarks = std::map<std::string, std::string>;

/// Returns sides and units of a topography, in metres.
Remarks remarks_of(const topography::Topography& topography);

/// Takes pixels and name from remarks, if they name a unit of length; also the unit of the heights,
/// if they name one.
void take_remarks(const Remarks& remarks, Layer& layer);

/// Heights of the lowest and the highest count of a picture of integers.
struct CountRange {
  double least = 0;  ///< of count 0, in the unit ZUnit
  double most = 0;   ///< of the largest count
};

/// Returns ZMin and ZMax; nullopt unless both are there and a unit of length is.
std::optional<CountRange> count_range(const Remarks& remarks);

}  // namespace tabor::scan::format
