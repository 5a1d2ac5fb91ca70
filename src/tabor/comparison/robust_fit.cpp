#include "tabor/comparison/robust_fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "tabor/core/error.hpp"

namespace tabor::comparison {
namespace {

double median(std::vector<double>& values) {
  const auto middle = values.begin() + std::ssize(values) / 2;
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double median_of(const Field& height) {
  std::vector<double> values;
  std::copy_if(height.data(), height.data() + height.size(), std::back_inserter(values),
               [](double z) { return !std::isnan(z); });
  return values.empty() ? 0 : median(values);
}

/// 1.4826 times the median distance from `centre`, or from the median without one.
double spread_about(const Field& height, const double* centre) {
  std::vector<double> values;
  std::copy_if(height.data(), height.data() + height.size(), std::back_inserter(values),
               [](double z) { return !std::isnan(z); });
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const double middle = centre ? *centre : median(values);
  for (double& value : values) value = std::abs(value - middle);
  return 1.482602218505602 * median(values);
}

}  // namespace

double robust_spread(const Field& height) { return spread_about(height, nullptr); }

Field remove_plane(const Field& height, const RobustPlane& plane) {
  Field result(height.rows(), height.cols());
  for_each_row(height.rows(), [&](Index y) {
    const double v = across(y, height.rows());
    for (Index x = 0; x < height.cols(); ++x) {
      result(y, x) =
          height(y, x) - plane.offset - plane.tilt_x * across(x, height.cols()) - plane.tilt_y * v;
    }
  });
  return result;
}

RobustPlane fit_robust_plane(const Field& height) {
  constexpr int most_steps = 30;
  const auto columns = [&](Index y, Index x) {
    return Eigen::Vector3d(1, across(x, height.cols()), across(y, height.rows()));
  };
  // From the median: a start from all heights can come to rest between two levels.
  RobustPlane plane{.offset = median_of(height)};
  plane.spread = robust_spread(height);
  double cutoff = kBiweightReach * std::max(plane.spread, std::numeric_limits<double>::min());
  for (int step = 0; step < most_steps; ++step) {
    const Field residual = remove_plane(height, plane);
    const auto equations = normal_equations<3>(residual, cutoff, columns);
    if (equations.n_points < 9) {
      throw InputError("fit of a plane", fmt::format("{} heights", equations.n_points),
                       "at least 9 valid heights", "");
    }
    const Eigen::Vector3d change = equations.solution();
    plane.offset += change[0];
    plane.tilt_x += change[1];
    plane.tilt_y += change[2];
    // About the plane, not about the median: half of the heights must lie within the cutoff.
    const double zero = 0;
    plane.spread = spread_about(remove_plane(height, plane), &zero);
    if (step > 0 && change.cwiseAbs().maxCoeff() <= 1e-6 * plane.spread) break;
    // Heights that are a plane but for rounding all count.
    const double rounding =
        1e-12 * (std::abs(plane.offset) + std::abs(plane.tilt_x) + std::abs(plane.tilt_y));
    cutoff =
        kBiweightReach * std::max({plane.spread, rounding, std::numeric_limits<double>::min()});
  }
  return plane;
}

}  // namespace tabor::comparison
