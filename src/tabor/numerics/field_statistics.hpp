#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "tabor/core/rows.hpp"

// Computes statistics of fields of shape (ny, nx); holes (NaN) are left out. All sums have the same
// bits for any number of threads.
namespace tabor::numerics {

/// Returns the largest difference that rounding can leave between heights of this magnitude: 64
/// units in their last place. Differences that are not larger count as zero.
inline double rounding_of(double magnitude) {
  return 64 * std::numeric_limits<double>::epsilon() * std::abs(magnitude);
}

/// Returns the largest |z| of the valid values; 0 without any.
double largest_magnitude(const Field& field);

/// True where the valid values are equal but for rounding; true without any.
bool is_flat(const Field& field);

/// Returns the result of a subtraction of heights of the given magnitude: zero, holes apart, if
/// rounding alone can have left it, else as it is.
Field without_rounding(Field rest, double magnitude);

/// Returns the mean of of_pixel(y, x) over n_rows times n_columns pixels without those where it is
/// NaN; NaN if there are no others.
template <typename OfPixel>
double mean_over(Index n_rows, Index n_columns, const OfPixel& of_pixel) {
  const auto sums = sum_over_rows<2>(std::max<Index>(0, n_rows), [&](Index y) {
    // All values first, so that they are vectorised.
    std::vector<double> values(static_cast<std::size_t>(std::max<Index>(0, n_columns)));
    for (Index x = 0; x < n_columns; ++x) values[static_cast<std::size_t>(x)] = of_pixel(y, x);
    double row = 0;
    double n = 0;
    for (const double value : values) {
      const bool counts = !std::isnan(value);
      row += counts ? value : 0;
      n += counts ? 1 : 0;
    }
    return Eigen::Array2d(row, n);
  });
  return sums[1] > 0 ? sums[0] / sums[1] : std::numeric_limits<double>::quiet_NaN();
}

/// Central moments of the valid values z of a field, divided by their number; in the unit of z or
/// a power of it.
struct FieldMoments {
  Index n = 0;  ///< valid values
  double mean = 0;
  double mean_abs = 0;                       ///< <|z|>, z about the mean
  double second = 0, third = 0, fourth = 0;  ///< <z^2>, <z^3>, <z^4>
  double highest = 0, lowest = 0;            ///< about the mean
};

/// Computes the moments. Throws InputError if every pixel is a hole.
FieldMoments field_moments(const Field& field);

/// Returns the root mean square about the mean of the valid values, in their unit. Throws as
/// field_moments().
double rms_height(const Field& height);

/// Returns the root mean square of the gradient [1] by forward differences, over the pixels with a
/// right and a lower neighbour, none of the three a hole: at most (nx-1)(ny-1). Pixels beyond the
/// edge are never taken from the other side. NaN without such pixels.
double rms_slope(const Field& height, const Grid& grid);

/// Returns the root mean square of the gradient by differences of sixth order, (z3 - 9 z2 + 45 z1 -
/// 45 z-1 + 9 z-2 - z-3) / (60 dx), over the pixels that are no holes and have three neighbours on
/// all four sides: at most (nx-6)(ny-6).
double seven_point_rms_slope(const Field& height, const Grid& grid);

/// Return the root mean square slope of heights along a line, `spacing` [m] apart.
double rms_slope(const Eigen::ArrayXd& height, double spacing);
double seven_point_rms_slope(const Eigen::ArrayXd& height, double spacing);

/// Mean squares of the forward differences along each axis over the spacing [1], each over all the
/// pairs of valid neighbours; NaN without pairs.
struct SquareSlopes {
  double along_x;
  double along_y;
};
SquareSlopes mean_square_slopes(const Field& height, const Grid& grid);

}  // namespace tabor::numerics
