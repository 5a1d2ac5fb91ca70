#pragma once

#include "tabor/topography/topography.hpp"

namespace tabor::topography {

/// A rectangle of pixels; (x0, y0) is its top left pixel.
struct PixelWindow {
  Index x0 = 0;
  Index y0 = 0;
  Index nx = 0;
  Index ny = 0;
};

/// The part inside the window; no longer periodic unless it is the whole. Throws InputError when
/// the window is empty or leaves the scan.
Topography crop(Topography topography, const PixelWindow& window);

/// The same area on nx * ny pixels: per axis the area average when there are fewer pixels than
/// before, a cubic spline through the pixel centres (natural ends, or periodic) when there are
/// more. Area averages use the valid part of each cell; splines need a field without holes.
Topography resample(Topography topography, Index nx, Index ny);

/// 2 x 2 tiling with its mirror images: twice the size, continuous across the edges, periodic.
Topography mirror(Topography topography);

enum class Axis { x, y };

/// Reverses the order of the columns (x) or rows (y).
Topography flip(Topography topography, Axis axis);

/// Exchanges rows and columns.
Topography transpose(Topography topography);

}  // namespace tabor::topography
