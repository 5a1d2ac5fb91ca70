#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tabor/core/error.hpp"
#include "tabor/topography/geometry.hpp"
#include "tabor/topography/rows.hpp"

namespace tabor::topography {
namespace {

/// One row averaged over n equal cells: each pixel counts by its overlap with the cell.
void average_row(const double* row, Index n_old, double* result, Index n_new) {
  const double width = static_cast<double>(n_old) / static_cast<double>(n_new);
  for (Index cell = 0; cell < n_new; ++cell) {
    const double begin = static_cast<double>(cell) * width;
    const double end = std::min(begin + width, static_cast<double>(n_old));
    double sum = 0;
    for (auto x = static_cast<Index>(begin); x < n_old && static_cast<double>(x) < end; ++x) {
      const double from = std::max(begin, static_cast<double>(x));
      sum += row[x] * (std::min(end, static_cast<double>(x + 1)) - from);
    }
    result[cell] = sum / width;
  }
}

/// Second derivatives of the cubic spline through equally spaced values: m_(i-1) + 4 m_i + m_(i+1)
/// = 6 (z_(i-1) - 2 z_i + z_(i+1)), natural ends (m = 0), by elimination.
std::vector<double> natural_moments(const std::vector<double>& z) {
  const std::size_t n = z.size();
  std::vector<double> moment(n, 0), factor(n, 0);
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double pivot = 4 - factor[i - 1];
    factor[i] = 1 / pivot;
    moment[i] = (6 * (z[i - 1] - 2 * z[i] + z[i + 1]) - moment[i - 1]) / pivot;
  }
  for (std::size_t i = n - 1; i-- > 1;) {
    moment[i] -= factor[i] * moment[i + 1];
  }
  return moment;
}

/// The spline through the pixel centres at the centres of n new pixels. `halo` extra samples on
/// either side (the row again if periodic, else its ends' tangents continue) make ends harmless:
/// what a wrong end does decays by 0.27 per pixel.
void spline_row(const double* row, Index n_old, double* result, Index n_new, bool periodic) {
  const Index halo = periodic ? 32 : 1;
  std::vector<double> z(static_cast<std::size_t>(n_old + 2 * halo));
  for (Index i = -halo; i < n_old + halo; ++i) {
    z[static_cast<std::size_t>(i + halo)] = row[((i % n_old) + n_old) % n_old];
  }
  if (!periodic) {
    z.front() = n_old > 1 ? 2 * row[0] - row[1] : row[0];
    z.back() = n_old > 1 ? 2 * row[n_old - 1] - row[n_old - 2] : row[0];
  }
  const auto moment = natural_moments(z);
  for (Index k = 0; k < n_new; ++k) {
    const double x =
        (static_cast<double>(k) + 0.5) * static_cast<double>(n_old) / static_cast<double>(n_new) -
        0.5 + static_cast<double>(halo);
    const auto i = std::min(static_cast<std::size_t>(x), z.size() - 2);
    const double b = x - static_cast<double>(i), a = 1 - b;
    result[k] = a * z[i] + b * z[i + 1] +
                ((a * a * a - a) * moment[i] + (b * b * b - b) * moment[i + 1]) / 6;
  }
}

/// Rows resampled to n columns.
Field along_rows(const Field& field, Index n, bool periodic) {
  if (n == field.cols()) {
    return field;
  }
  Field result(field.rows(), n);
  for_each_row(field.rows(), [&](Index y) {
    if (n < field.cols()) {
      average_row(&field(y, 0), field.cols(), &result(y, 0), n);
    } else {
      spline_row(&field(y, 0), field.cols(), &result(y, 0), n, periodic);
    }
  });
  return result;
}

Field along_both(const Field& field, Index nx, Index ny, bool periodic) {
  const Field rows = along_rows(field, nx, periodic).transpose();
  return along_rows(rows, ny, periodic).transpose();
}

/// Averages over the valid part of each new pixel; a pixel that is valid by less than half is a
/// hole.
Field average_with_holes(const Field& height, Index nx, Index ny) {
  const auto missing = height.isNaN();
  const Field share = along_both(1 - missing.cast<double>(), nx, ny, false);
  const Field total = along_both(missing.select(0, height), nx, ny, false);
  return (share >= 0.5).select(total / share, std::numeric_limits<double>::quiet_NaN());
}

void check_size(const Topography& topography, Index nx, Index ny) {
  const Grid& grid = topography.grid;
  constexpr Index largest = 1 << 16;
  if (nx < 1 || ny < 1 || nx > largest || ny > largest) {
    throw InputError("resample", fmt::format("{},{} pixels", nx, ny),
                     fmt::format("nx,ny between 1 and {}", largest), "");
  }
  if ((nx > grid.nx || ny > grid.ny) && topography.height.hasNaN()) {
    throw InputError("resample to more pixels",
                     fmt::format("{} missing heights", count_holes(topography)),
                     "a surface without holes", "fill them first (--fill harmonic)");
  }
}

}  // namespace

Topography resample(Topography topography, Index nx, Index ny) {
  check_size(topography, nx, ny);
  const Field& height = topography.height;
  topography.height = height.hasNaN() ? average_with_holes(height, nx, ny)
                                      : along_both(height, nx, ny, topography.periodic);
  topography.history.push_back(fmt::format(
      "resample={},{}: from {} x {} pixels, {} along x, {} along y", nx, ny, topography.grid.nx,
      topography.grid.ny, nx > topography.grid.nx ? "spline" : "area average",
      ny > topography.grid.ny ? "spline" : "area average"));
  topography.grid.nx = nx;
  topography.grid.ny = ny;
  return topography;
}

}  // namespace tabor::topography
