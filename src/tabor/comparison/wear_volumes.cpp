#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tabor/comparison/changes.hpp"
#include "tabor/comparison/combine.hpp"
#include "tabor/comparison/robust_fit.hpp"
#include "tabor/core/error.hpp"
#include "tabor/numerics/small_matrices.hpp"

namespace tabor::comparison {
namespace {

/// Sums over the pixels of a region of the loss and of 1, u, v (coordinates across the map).
struct Region {
  double loss = 0;  ///< [m]
  Eigen::Vector3d plane = Eigen::Vector3d::Zero();
};

Region region_of(const Field& loss, const Mask& mask) {
  const auto sums = sum_over_rows<4>(loss.rows(), [&](Index y) {
    Eigen::Array4d row = Eigen::Array4d::Zero();
    for (Index x = 0; x < loss.cols(); ++x) {
      if (mask(y, x)) {
        row += Eigen::Array4d(loss(y, x), 1, across(x, loss.cols()), across(y, loss.rows()));
      }
    }
    return row;
  });
  return {sums[0], sums.tail<3>().matrix()};
}

/// Covariance of what is fitted to the pixels of a mask, in units of their variance.
Eigen::Matrix3d covariance_of_fit(const Mask& mask, LevelMatch level) {
  if (level == LevelMatch::none) return Eigen::Matrix3d::Zero();
  if (level == LevelMatch::offset) {
    return Eigen::Vector3d(1 / static_cast<double>(mask.count()), 0, 0).asDiagonal();
  }

  const auto sums = sum_over_rows<9>(mask.rows(), [&](Index y) {
    Eigen::Matrix3d row = Eigen::Matrix3d::Zero();
    for (Index x = 0; x < mask.cols(); ++x) {
      if (!mask(y, x)) continue;
      const Eigen::Vector3d at(1, across(x, mask.cols()), across(y, mask.rows()));
      row += at * at.transpose();
    }
    return Eigen::Array<double, 9, 1>(row.reshaped());
  });
  return numerics::determined_inverse(
      Eigen::Matrix3d(Eigen::Map<const Eigen::Matrix3d>(sums.data())));
}

/// What the volumes of one map share.
struct Noise {
  double variance = 0;        ///< [m^2] of a pixel, times the number that vary together
  bool is_determined = true;  ///< the plane: by enough quiet pixels, or nothing was fitted
  Eigen::Matrix3d plane;      ///< covariance_of_fit() to the quiet pixels
};

/// Variance of a sum over a region, whose part `quiet` the plane rests on: of its own noise, of the
/// plane under it, and of what the two share. Without enough quiet pixels the plane may lie
/// anywhere within the noise.
Volume volume_of(const Region& region, const Region& quiet, const Noise& noise, double pixel_area) {
  const double n = region.plane[0];
  const double of_plane =
      noise.is_determined
          ? region.plane.dot(noise.plane * (region.plane / kBiweightEfficiency - 2 * quiet.plane))
          : n * n;
  const double n_varying = std::max(0.0, n + of_plane);
  return {region.loss * pixel_area, pixel_area * std::sqrt(noise.variance * n_varying),
          n * pixel_area};
}

}  // namespace

WearVolumes wear_volumes(const Field& loss, const Grid& grid, const LossOptions& options) {
  if (!(options.threshold > 0) || !std::isfinite(options.threshold)) {
    throw InputError("threshold of a change", fmt::format("{}", options.threshold),
                     "a positive number of standard deviations", "e.g. <threshold=4>");
  }
  const double pixel_area = grid.pixel_area();
  const Changes changes = find_changes(loss, grid, options.threshold, options.resolution);
  const double correlated = correlated_pixels(loss, grid, changes.quiet);
  const Noise noise{
      .variance = changes.noise * changes.noise * correlated,
      .is_determined = options.level == LevelMatch::none || changes.quiet.count() >= 9,
      .plane = covariance_of_fit(changes.quiet, options.level)};
  WearVolumes result;
  result.threshold = changes.threshold;
  result.noise = changes.noise;
  result.noise_area = correlated * pixel_area;
  result.worn = volume_of(region_of(loss, changes.worn), {}, noise, pixel_area);
  result.piled_up = volume_of(region_of(-loss, changes.piled_up), {}, noise, pixel_area);
  result.net =
      volume_of(region_of(loss, !loss.isNaN()), region_of(loss, changes.quiet), noise, pixel_area);
  result.noise_floor = changes.floor * pixel_area;
  return result;
}

}  // namespace tabor::comparison
