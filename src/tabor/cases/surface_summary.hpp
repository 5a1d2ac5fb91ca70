#pragma once

#include <string>

#include "tabor/cases/records.hpp"
#include "tabor/topography/topography.hpp"

// Summarises a surface: pixels, size, holes and the range of its heights.
namespace tabor::cases {

/// Size, holes and heights of a surface. Heights are NaN where all pixels are holes.
struct SurfaceRecord {
  std::string channel;
  Grid grid;
  bool periodic = false;
  Index missing_pixels = 0;
  double min = kNoValue;      ///< [m]
  double max = kNoValue;      ///< [m]
  double rms = kNoValue;      ///< about the mean [m]
  double tilt = kNoValue;     ///< by how much the least-squares plane rises over both sides [m]
  double quantum = kNoValue;  ///< step that all heights are multiples of [m]; NaN without one

  /// Returns the share of the pixels without a height.
  double missing_fraction() const {
    return static_cast<double>(missing_pixels) / static_cast<double>(grid.size());
  }
};
/// Columns under the keys of `tabor info --json`.
const Columns<SurfaceRecord>& surface_columns();

/// Summarises a surface as it is.
SurfaceRecord summary_of(const topography::Topography& surface);

}  // namespace tabor::cases
