#include "tabor/ehl/point/roughness.hpp"

#include <fmt/format.h>

#include <Eigen/SparseCore>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "tabor/core/error.hpp"

namespace tabor::ehl {
namespace {

constexpr double kMinNodesPerWavelength = 8;
constexpr double kTaper = 0.2;  // of the way from the middle of a map to its border

using Interpolation = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// Points of a map along one axis.
struct MapAxis {
  Index n_points = 0;
  double spacing = 0;  // [m]
  double centre = 0;   // [m]

  double half() const { return 0.5 * spacing * static_cast<double>(n_points - 1); }
  /// Returns the place of a coordinate [m] among the points, from 0.
  double place(double at) const { return (at - centre + half()) / spacing; }
  /// 1 inside, 0 from the border of the map on.
  double taper(double at) const {
    const double to_border = (1 - std::abs(at - centre) / half()) / kTaper;
    const double sine = std::sin(0.5 * std::numbers::pi * std::clamp(to_border, 0.0, 1.0));
    return sine * sine;
  }
};

/// Weights of four neighbours in the value at a share 0..1 of the way between the middle two: Keys
/// 1981 with a = -1/2.
std::array<double, 4> cubic_weights(double share) {
  const auto near = [](double d) { return (1.5 * d - 2.5) * d * d + 1; };
  const auto far = [](double d) { return ((-0.5 * d + 2.5) * d - 4) * d + 2; };
  return {far(1 + share), near(share), near(1 - share), far(2 - share)};
}

/// Heights at the nodes of one axis = interpolation * heights at the points of the map. Each is the
/// mean of n_samples values spread over the cell of its node.
Interpolation interpolate(const MapAxis& map, const Eigen::ArrayXd& nodes) {
  const double cell = nodes[1] - nodes[0];
  const Index n_samples = std::max<Index>(1, std::llround(cell / map.spacing));
  std::vector<Eigen::Triplet<double>> weights;
  weights.reserve(static_cast<std::size_t>(4 * n_samples * nodes.size()));
  for (Index i = 0; i < nodes.size(); ++i) {
    const double share_of_sample = map.taper(nodes[i]) / static_cast<double>(n_samples);
    if (!(share_of_sample > 0)) continue;
    for (Index k = 0; k < n_samples; ++k) {
      const double offset = (static_cast<double>(k) + 0.5) / static_cast<double>(n_samples) - 0.5;
      const double place = map.place(nodes[i] + offset * cell);
      const double before = std::floor(place);
      const std::array<double, 4> cubic = cubic_weights(place - before);
      for (Index j = 0; j < 4; ++j) {
        const Index point = std::clamp<Index>(static_cast<Index>(before) - 1 + j, 0,
                                              map.n_points - 1);  // none lies beyond the border
        weights.emplace_back(i, point, share_of_sample * cubic[static_cast<std::size_t>(j)]);
      }
    }
  }
  Interpolation matrix(nodes.size(), map.n_points);
  matrix.setFromTriplets(weights.begin(), weights.end());
  return matrix;
}

void check_reach(const MapAxis& map, double half_axis, const char* along) {
  const double needed = kMapReach * half_axis + std::abs(map.centre);
  if (!(map.half() >= needed)) {
    throw InputError(fmt::format("height map {}", along),
                     fmt::format("{:.4g} m from its middle to its border", map.half()),
                     fmt::format("{:.4g} m or more, {} times the half axis of the dry contact",
                                 needed, kMapReach),
                     "a larger map, a smaller load, or a place of the map closer to the contact");
  }
}

}  // namespace

Field point_bump(const PointProblem& problem, double height, double wavelength, double centre_x,
                 double centre_y) {
  const Eigen::ArrayXd x = point_x(problem);
  const Eigen::ArrayXd y = point_y(problem);
  const double shortest = kMinNodesPerWavelength * std::max(x[1] - x[0], y[1] - y[0]);
  if (!(wavelength >= shortest) || !std::isfinite(height)) {
    throw InputError("wavelength of a bump", fmt::format("{:.4g} m", wavelength),
                     fmt::format("{:.4g} m or more on this grid", shortest), "give more nodes");
  }
  return Field::NullaryExpr(y.size(), x.size(), [&](Index j, Index i) {
    const double r = std::hypot(x[i] - centre_x, y[j] - centre_y) / wavelength;
    return height * std::pow(10.0, -10 * r * r) * std::cos(2 * std::numbers::pi * r);
  });
}

Field point_map(const PointProblem& problem, const PointMap& map) {
  if (!map.height.isFinite().all()) {
    throw InputError("height map", "holes", "a height everywhere",
                     "fill them first: tabor convert --fill harmonic");
  }
  if (!(map.spacing_x > 0) || !(map.spacing_y > 0)) {
    throw InputError("height map", fmt::format("a spacing of {} m", map.spacing_x),
                     "a positive one", "");
  }
  const reference::HertzEllipse hertz = hertz_of(problem);
  const MapAxis columns{map.height.cols(), map.spacing_x, map.centre_x};
  const MapAxis rows{map.height.rows(), map.spacing_y, map.centre_y};
  check_reach(columns, hertz.half_axis_x, "along the flow");
  check_reach(rows, hertz.half_axis_y, "across the flow");
  const Eigen::MatrixXd along =
      interpolate(columns, point_x(problem)) * Eigen::MatrixXd(map.height.matrix().transpose());
  const Eigen::MatrixXd both = interpolate(rows, point_y(problem)) * along.transpose();
  return both.array();
}

}  // namespace tabor::ehl
