#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "tabor/core/error.hpp"
#include "tabor/core/rows.hpp"
#include "tabor/topography/geometry.hpp"
#include "tabor/topography/holes.hpp"

namespace tabor::topography {
namespace {

/// One row averaged over n equal cells: each pixel counts by its overlap with the cell.
void average_row(const double* row, Index n_old, double* result, Index n_new, double width) {
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
  for (std::size_t i = n - 1; i-- > 1;) moment[i] -= factor[i] * moment[i + 1];
  return moment;
}

/// The spline through the pixel centres at n new points, the k-th at position(k). `halo` extra
/// samples on either side (the row again if periodic, else its ends' tangents continue) make ends
/// harmless: what a wrong end does decays by 0.27 per pixel.
template <typename Position>
void spline_row(const double* row, Index n_old, double* result, Index n_new, bool periodic,
                const Position& position) {
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
    const double x = position(k) + static_cast<double>(halo);
    const auto i = std::min(static_cast<std::size_t>(x), z.size() - 2);
    const double b = x - static_cast<double>(i), a = 1 - b;
    result[k] = a * z[i] + b * z[i + 1] +
                ((a * a * a - a) * moment[i] + (b * b * b - b) * moment[i + 1]) / 6;
  }
}

/// Rows resampled to n columns.
Field along_rows(const Field& field, Index n, bool periodic) {
  if (n == field.cols()) return field;
  Field result(field.rows(), n);
  for_each_row(field.rows(), [&](Index y) {
    const auto n_old = static_cast<double>(field.cols()), n_new = static_cast<double>(n);
    if (n < field.cols()) {
      average_row(&field(y, 0), field.cols(), &result(y, 0), n, n_old / n_new);
    } else {
      spline_row(&field(y, 0), field.cols(), &result(y, 0), n, periodic,
                 [&](Index k) { return (static_cast<double>(k) + 0.5) * n_old / n_new - 0.5; });
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
                     "a surface without holes", "fill them first (<fill=harmonic>)");
  }
}

/// Cells of the given width along rows.
Field means_along_rows(const Field& field, double width) {
  const auto n = static_cast<Index>(static_cast<double>(field.cols()) / width + 1e-9);
  Field result(field.rows(), n);
  for_each_row(field.rows(),
               [&](Index y) { average_row(&field(y, 0), field.cols(), &result(y, 0), n, width); });
  return result;
}

/// Points of a lattice along one axis of n pixels; those beyond it stand at its ends.
struct Positions {
  double first;
  double step;
  Index n;
  double operator()(Index k) const {
    return std::clamp(first + static_cast<double>(k) * step, 0.0, static_cast<double>(n - 1));
  }
  bool is_inside(Index k) const {
    constexpr double edge = 0.05;
    const double x = first + static_cast<double>(k) * step;
    return x >= -edge && x <= static_cast<double>(n - 1) + edge;
  }
};

Field splines_along_rows(const Field& field, const Positions& positions, Index n) {
  Field result(field.rows(), n);
  for_each_row(field.rows(), [&](Index y) {
    spline_row(&field(y, 0), field.cols(), &result(y, 0), n, false, positions);
  });
  return result;
}

/// Makes holes of points outside, or next to a hole.
void blank(Field& result, const Mask& missing, const Positions& x, const Positions& y) {
  for_each_row(result.rows(), [&](Index j) {
    const auto v = static_cast<Index>(y(j));
    const Index below = std::min(v + 1, missing.rows() - 1);
    for (Index i = 0; i < result.cols(); ++i) {
      const auto u = static_cast<Index>(x(i));
      const Index right = std::min(u + 1, missing.cols() - 1);
      const bool near_hole =
          missing(v, u) || missing(v, right) || missing(below, u) || missing(below, right);
      if (!x.is_inside(i) || !y.is_inside(j) || near_hole) {
        result(j, i) = std::numeric_limits<double>::quiet_NaN();
      }
    }
  });
}

}  // namespace

Field cell_means(const Field& height, double width_x, double width_y) {
  const auto both = [&](const Field& field) {
    const Field rows = means_along_rows(field, width_x).transpose();
    return Field(means_along_rows(rows, width_y).transpose());
  };
  const auto missing = height.isNaN();
  const Field share = both(1 - missing.cast<double>());
  const Field total = both(missing.select(0, height));
  return (share >= 0.5).select(total / share, std::numeric_limits<double>::quiet_NaN());
}

Interpolant::Interpolant(const Field& height) : whole_(height), missing_(height.isNaN()) {
  if (missing_.any()) {
    const Grid pixels{height.cols(), height.rows(), static_cast<double>(height.cols()),
                      static_cast<double>(height.rows())};
    whole_ = fill_holes(height, pixels, Fill::harmonic).height;
  }
}

Field Interpolant::at(const Lattice& lattice) const {
  const Positions x{lattice.x0, lattice.step_x, whole_.cols()};
  const Positions y{lattice.y0, lattice.step_y, whole_.rows()};
  const Field rows = splines_along_rows(whole_, x, lattice.nx).transpose();
  Field result = splines_along_rows(rows, y, lattice.ny).transpose();
  blank(result, missing_, x, y);
  return result;
}

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
