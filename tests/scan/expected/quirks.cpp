#include "quirks.hpp"

#include <cmath>

namespace tabor::scan::test {
namespace {

double square_sum(const Field& z) { return z.isNaN().select(0, z.square()).sum(); }

}  // namespace

double rms_height_over_all_points(const topography::Topography& topography) {
  const Field& z = topography.height;
  const auto n = static_cast<double>(z.size());
  const double mean = z.isNaN().select(0, z).sum() / n;
  return std::sqrt(square_sum(z - mean) / n);
}

double rms_row_height_over_all_points(const topography::Topography& topography) {
  Field z = topography.height;
  for (Index y = 0; y < z.rows(); ++y) {
    const double mean = z.row(y).isNaN().select(0, z.row(y)).sum() / static_cast<double>(z.cols());
    z.row(y) -= mean;
  }
  return std::sqrt(square_sum(z) / static_cast<double>(z.size()));
}

double rms_slope_over_all_points(const topography::Topography& topography) {
  const Field& z = topography.height;
  const Index nx = z.cols(), ny = z.rows();
  const Field along_x = (z.rightCols(nx - 1) - z.leftCols(nx - 1)) / topography.grid.dx();
  const Field along_y = (z.bottomRows(ny - 1) - z.topRows(ny - 1)) / topography.grid.dy();
  return std::sqrt((square_sum(along_x) + square_sum(along_y)) / static_cast<double>(z.size()));
}

}  // namespace tabor::scan::test
