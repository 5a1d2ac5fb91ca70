#include "tabor/numerics/field_statistics.hpp"

#include "tabor/core/error.hpp"

namespace tabor::numerics {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

double mean_of_valid(const Field& field, Index& n) {
  const auto sums = sum_over_rows<2>(field.rows(), [&](Index y) {
    Eigen::Array2d row = Eigen::Array2d::Zero();
    for (Index x = 0; x < field.cols(); ++x) {
      if (!std::isnan(field(y, x))) row += Eigen::Array2d(field(y, x), 1);
    }
    return row;
  });
  n = static_cast<Index>(sums[1]);
  if (n == 0) {
    throw InputError("surface statistics", "a surface of holes only", "some valid heights", "");
  }
  return sums[0] / sums[1];
}

/// Sums of d, |d|, d^2, d^3, d^4 with d = z - mean over one row.
Eigen::Array<double, 5, 1> row_powers(const Field& field, Index y, double mean) {
  Eigen::Array<double, 5, 1> sums = Eigen::Array<double, 5, 1>::Zero();
  for (Index x = 0; x < field.cols(); ++x) {
    const double d = field(y, x) - mean;
    if (!std::isnan(d)) {
      const double square = d * d;
      sums[0] += d;
      sums[1] += std::abs(d);
      sums[2] += square;
      sums[3] += square * d;
      sums[4] += square * square;
    }
  }
  return sums;
}

/// Sixth-order difference of the seven values z[-3 step] .. z[3 step], times the spacing.
double seven_point_difference(const double* z, Index step) {
  return (z[3 * step] - 9 * z[2 * step] + 45 * z[step] - 45 * z[-step] + 9 * z[-2 * step] -
          z[-3 * step]) /
         60;
}

double rms_of(const Eigen::ArrayXd& slope) {
  return std::sqrt(mean_over(1, slope.size(), [&](Index, Index x) { return slope[x] * slope[x]; }));
}

}  // namespace

double largest_magnitude(const Field& field) {
  double largest = 0;
  for (const double z : field.reshaped<Eigen::RowMajor>()) {
    largest = std::fmax(largest, std::abs(z));
  }
  return largest;
}

bool is_flat(const Field& field) {
  double highest = kNan, lowest = kNan;
  for (const double z : field.reshaped<Eigen::RowMajor>()) {
    highest = std::fmax(highest, z);
    lowest = std::fmin(lowest, z);
  }
  return !(highest - lowest > rounding_of(std::fmax(std::abs(highest), std::abs(lowest))));
}

Field without_rounding(Field rest, double magnitude) {
  if (largest_magnitude(rest) > rounding_of(magnitude)) return rest;
  return rest.isNaN().select(rest, 0);
}

FieldMoments field_moments(const Field& field) {
  FieldMoments m;
  m.mean = mean_of_valid(field, m.n);
  m.highest = field.maxCoeff<Eigen::PropagateNumbers>();
  m.lowest = field.minCoeff<Eigen::PropagateNumbers>();
  if (m.highest - m.lowest <= rounding_of(std::max(std::abs(m.highest), std::abs(m.lowest)))) {
    return {.n = m.n, .mean = m.highest};  // flat, whatever the rounding of the mean
  }
  const auto n = static_cast<double>(m.n);
  // One more pass for the mean: a scan 1 m above its datum keeps nanometres only this way.
  m.mean +=
      sum_over_rows<5>(field.rows(), [&](Index y) { return row_powers(field, y, m.mean); })[0] / n;
  const auto sums =
      sum_over_rows<5>(field.rows(), [&](Index y) { return row_powers(field, y, m.mean); });
  m.mean_abs = sums[1] / n;
  m.second = sums[2] / n;
  m.third = sums[3] / n;
  m.fourth = sums[4] / n;
  m.highest -= m.mean;
  m.lowest -= m.mean;
  return m;
}

double rms_height(const Field& height) { return std::sqrt(field_moments(height).second); }

double rms_slope(const Field& z, const Grid& grid) {
  const double dx = grid.dx(), dy = grid.dy();
  return std::sqrt(mean_over(grid.ny - 1, grid.nx - 1, [&](Index y, Index x) {
    const double slope_x = (z(y, x + 1) - z(y, x)) / dx;
    const double slope_y = (z(y + 1, x) - z(y, x)) / dy;
    return slope_x * slope_x + slope_y * slope_y;
  }));
}

double seven_point_rms_slope(const Field& z, const Grid& grid) {
  return std::sqrt(mean_over(grid.ny - 6, grid.nx - 6, [&](Index y, Index x) {
    const double* pixel = &z(y + 3, x + 3);
    if (std::isnan(*pixel)) return kNan;
    const double slope_x = seven_point_difference(pixel, 1) / grid.dx();
    const double slope_y = seven_point_difference(pixel, z.cols()) / grid.dy();
    return slope_x * slope_x + slope_y * slope_y;
  }));
}

double rms_slope(const Eigen::ArrayXd& z, double spacing) {
  const Index n = z.size() - 1;
  if (n < 1) return kNan;
  return rms_of((z.tail(n) - z.head(n)) / spacing);
}

double seven_point_rms_slope(const Eigen::ArrayXd& z, double spacing) {
  const Index n = z.size() - 6;
  if (n < 1) return kNan;
  return rms_of((z.tail(n) - 9 * z.segment(5, n) + 45 * z.segment(4, n) - 45 * z.segment(2, n) +
                 9 * z.segment(1, n) - z.head(n)) /
                (60 * spacing));
}

SquareSlopes mean_square_slopes(const Field& height, const Grid& grid) {
  const auto square = [](double slope) { return slope * slope; };
  return {mean_over(grid.ny, grid.nx - 1,
                    [&](Index y, Index x) {
                      return square((height(y, x + 1) - height(y, x)) / grid.dx());
                    }),
          mean_over(grid.ny - 1, grid.nx, [&](Index y, Index x) {
            return square((height(y + 1, x) - height(y, x)) / grid.dy());
          })};
}

}  // namespace tabor::numerics
