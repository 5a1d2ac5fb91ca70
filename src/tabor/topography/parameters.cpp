#include "tabor/topography/parameters.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tabor/core/error.hpp"
#include "tabor/topography/rows.hpp"

namespace tabor::topography {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// Central moments of the valid heights, divided by their number.
struct Moments {
  Index n = 0;
  double mean = 0;
  double mean_abs = 0;
  double second = 0, third = 0, fourth = 0;
  double highest = 0, lowest = 0;  ///< about the mean
};

double mean_of_valid(const Field& height, Index& n) {
  const auto sums = sum_over_rows<2>(height.rows(), [&](Index y) {
    Eigen::Array2d row = Eigen::Array2d::Zero();
    for (Index x = 0; x < height.cols(); ++x) {
      if (!std::isnan(height(y, x))) {
        row += Eigen::Array2d(height(y, x), 1);
      }
    }
    return row;
  });
  n = static_cast<Index>(sums[1]);
  if (n == 0) {
    throw InputError("surface parameters", "a surface of holes only", "some valid heights", "");
  }
  return sums[0] / sums[1];
}

/// Sums of d, |d|, d^2, d^3, d^4 with d = z - mean over one row.
Eigen::Array<double, 5, 1> row_powers(const Field& height, Index y, double mean) {
  Eigen::Array<double, 5, 1> sums = Eigen::Array<double, 5, 1>::Zero();
  for (Index x = 0; x < height.cols(); ++x) {
    const double d = height(y, x) - mean;
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

Moments moments_of(const Field& height) {
  Moments m;
  m.mean = mean_of_valid(height, m.n);
  const auto n = static_cast<double>(m.n);
  // One more pass for the mean: a scan 1 m above its datum keeps nanometres only this way.
  m.mean +=
      sum_over_rows<5>(height.rows(), [&](Index y) { return row_powers(height, y, m.mean); })[0] /
      n;
  const auto sums =
      sum_over_rows<5>(height.rows(), [&](Index y) { return row_powers(height, y, m.mean); });
  m.mean_abs = sums[1] / n;
  m.second = sums[2] / n;
  m.third = sums[3] / n;
  m.fourth = sums[4] / n;
  m.highest = height.maxCoeff<Eigen::PropagateNumbers>() - m.mean;
  m.lowest = height.minCoeff<Eigen::PropagateNumbers>() - m.mean;
  return m;
}

/// sqrt(1 + s) - 1 without losing small s.
double excess_length(double s) { return s / (1 + std::sqrt(1 + s)); }

/// Developed over projected area, minus one, of one cell: both triangulations, averaged.
/// Each triangle spans one x edge and one y edge, hence has the slopes of these two edges.
double cell_excess(double z00, double z10, double z01, double z11, double dx, double dy) {
  const double top = (z10 - z00) / dx, bottom = (z11 - z01) / dx;
  const double left = (z01 - z00) / dy, right = (z11 - z10) / dy;
  return (excess_length(top * top + left * left) + excess_length(bottom * bottom + right * right) +
          excess_length(top * top + right * right) + excess_length(bottom * bottom + left * left)) /
         4;
}

/// Mean over the (nx-1)(ny-1) cells of of_cell(y, x), cells where it is NaN left out.
template <typename OfCell>
double mean_over_cells(const Grid& grid, const OfCell& of_cell) {
  const auto sums = sum_over_rows<2>(grid.ny - 1, [&](Index y) {
    Eigen::Array2d row = Eigen::Array2d::Zero();
    for (Index x = 0; x + 1 < grid.nx; ++x) {
      const double value = of_cell(y, x);
      if (!std::isnan(value)) {
        row += Eigen::Array2d(value, 1);
      }
    }
    return row;
  });
  return sums[1] > 0 ? sums[0] / sums[1] : kNan;
}

}  // namespace

double rms_slope(const Topography& topography) {
  const Field& z = topography.height;
  const double dx = topography.grid.dx(), dy = topography.grid.dy();
  return std::sqrt(mean_over_cells(topography.grid, [&](Index y, Index x) {
    const double slope_x = (z(y, x + 1) - z(y, x)) / dx;
    const double slope_y = (z(y + 1, x) - z(y, x)) / dy;
    return slope_x * slope_x + slope_y * slope_y;
  }));
}

double developed_area_ratio(const Topography& topography) {
  const Field& z = topography.height;
  const double dx = topography.grid.dx(), dy = topography.grid.dy();
  return 100 * mean_over_cells(topography.grid, [&](Index y, Index x) {
           return cell_excess(z(y, x), z(y, x + 1), z(y + 1, x), z(y + 1, x + 1), dx, dy);
         });
}

double rms_height(const Topography& topography) {
  return std::sqrt(moments_of(topography.height).second);
}

std::vector<Parameter> parameters(const Topography& topography) {
  const Moments m = moments_of(topography.height);
  const double sq = std::sqrt(m.second);
  const bool rough = sq > 0;
  const std::string about = "; z about the mean of the valid points of the surface as given";
  return {
      {"Sa", m.mean_abs, "m", "arithmetic mean height <|z|>" + about},
      {"Sq", sq, "m", "root mean square height sqrt(<z^2>), divided by N" + about},
      {"Ssk", rough ? m.third / (m.second * sq) : kNan, "1", "skewness <z^3>/Sq^3" + about},
      {"Sku", rough ? m.fourth / (m.second * m.second) : kNan, "1",
       "kurtosis <z^4>/Sq^4 (3 for a Gaussian surface)" + about},
      {"Sp", m.highest, "m", "highest peak max z" + about},
      {"Sv", -m.lowest, "m", "deepest pit -min z" + about},
      {"Sz", m.highest - m.lowest, "m", "maximum height Sp + Sv"},
      {"Sdq", rms_slope(topography), "1",
       "root mean square gradient sqrt(<(dz/dx)^2 + (dz/dy)^2>), forward differences on the common "
       "(nx-1)(ny-1) grid, gradients touching a hole left out"},
      {"Sdr", developed_area_ratio(topography), "%",
       "developed interfacial area ratio 100 (developed/projected - 1), mean of both splits of "
       "each "
       "cell into two triangles, cells touching a hole left out"},
      {"N", static_cast<double>(m.n), "1", "valid points (pixels that are not holes)"},
  };
}

}  // namespace tabor::topography
