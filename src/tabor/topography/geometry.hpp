#pragma once

#include <optional>

#include "tabor/topography/topography.hpp"

// Crops, resamples, mirrors, flips and transposes surfaces, and interpolates between their pixels.
namespace tabor::topography {

/// Rectangle of pixels; (x0, y0) is its top left pixel.
struct PixelWindow {
  Index x0 = 0;
  Index y0 = 0;
  Index nx = 0;
  Index ny = 0;
};

/// Returns the part inside the window; no longer periodic unless it is the whole. Throws InputError
/// when the window is empty or leaves the scan.
Topography crop(Topography topography, const PixelWindow& window);

/// Removes a margin of mx columns and my rows on every side. Throws InputError when nothing is
/// left.
Topography trim_margins(Topography topography, Index mx, Index my);

/// Resamples the same area to nx * ny pixels: per axis the area average when there are fewer pixels
/// than before, a cubic spline through the pixel centres (natural ends, or periodic) when there are
/// more. Area averages use the valid part of each cell; splines need a field without holes.
Topography resample(Topography topography, Index nx, Index ny);

/// Points over a map, in its pixels: the centre of pixel (i, j) is x = i, y = j.
struct Lattice {
  double x0 = 0;  ///< of the first point
  double y0 = 0;
  double step_x = 1;
  double step_y = 1;
  Index nx = 0;
  Index ny = 0;
};

/// Interpolates heights between the pixels by cubic splines along both axes.
class Interpolant {
 public:
  /// Prepares the interpolation of heights with or without holes (NaN).
  explicit Interpolant(const Field& height);
  /// Returns the heights at the points, shape (lattice.ny, lattice.nx). NaN beyond the outermost
  /// pixel centres by more than a twentieth of a pixel (up to there points have the outermost
  /// height, so that two scans in register keep all rows), and where one of the four nearest pixels
  /// is a hole.
  Field at(const Lattice& lattice) const;

 private:
  Field whole_;  ///< holes filled, so that splines pass them undisturbed
  Mask missing_;
};

/// Returns means over cells of width_x * width_y pixels (1 or more), from the top left corner; a
/// rest too narrow for a cell is left out. A cell of which less than half is valid is a hole.
Field cell_means(const Field& height, double width_x, double width_y);

/// Tiles the surface 2 x 2 with its mirror images: twice the size, continuous across the edges,
/// periodic. A surface that its mirror images continue already stays as it is. Throws InputError
/// for a surface that is said to repeat or to end at its edges.
Topography mirror(Topography topography);

/// Returns the scan that mirror images continue, without what is known of its edges; nothing for
/// other surfaces.
std::optional<Topography> scan_of_images(const Topography& topography);

/// Direction of the map.
enum class Axis { x, y };

/// Reverses the order of the columns (x) or rows (y).
Topography flip(Topography topography, Axis axis);

/// Exchanges rows and columns.
Topography transpose(Topography topography);

}  // namespace tabor::topography
