#pragma once

#include <Eigen/Core>
#include <cstdint>

// Defines Grid, Field, Mask and ByteMap, the maps that all modules share.
namespace tabor {

/// Type of counts and positions of pixels.
using Index = Eigen::Index;

/// Map sampled on a Grid: shape (ny, nx), row 0 is the top row, x (columns) is the fast axis and
/// the sliding direction.
using Field = Eigen::Array<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using FieldF = Eigen::Array<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// True where a pixel is selected (a hole, a contact pixel, ...); same layout as Field.
using Mask = Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Map of small integers (holes, contact states); same layout as Field.
using ByteMap = Eigen::Array<std::uint8_t, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Cell-centred regular grid: nx * ny pixels cover lx * ly [m], extent = n * spacing.
struct Grid {
  Index nx = 0;
  Index ny = 0;
  double lx = 0;  ///< [m]
  double ly = 0;  ///< [m]

  /// Width of a pixel [m].
  double dx() const { return lx / static_cast<double>(nx); }
  /// Height of a pixel [m].
  double dy() const { return ly / static_cast<double>(ny); }
  /// [m^2]
  double pixel_area() const { return dx() * dy(); }
  /// Nominal area [m^2].
  double area() const { return lx * ly; }
  /// Number of pixels.
  Index size() const { return nx * ny; }
  bool operator==(const Grid&) const = default;
};

}  // namespace tabor
