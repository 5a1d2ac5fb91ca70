#include "tabor/comparison/combine.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "tabor/comparison/changes.hpp"
#include "tabor/comparison/robust_fit.hpp"
#include "tabor/core/error.hpp"
#include "tabor/core/names.hpp"
#include "tabor/core/units.hpp"
#include "tabor/core/watch.hpp"
#include "tabor/numerics/field_statistics.hpp"
#include "tabor/topography/geometry.hpp"

namespace tabor::comparison {
namespace {

constexpr auto kModes = names<CombineMode>("wear", "difference", "composite");
constexpr auto kMatches = names<LevelMatch>("none", "offset", "plane");

/// A on pixels as large as B's, where those are larger by half or more.
topography::Topography onto_coarser_pixels(topography::Topography a, const Grid& b) {
  const double x = std::max(1.0, b.dx() / a.grid.dx()), y = std::max(1.0, b.dy() / a.grid.dy());
  if (x < 1.5 && y < 1.5) return a;
  const double dx = a.grid.dx() * x, dy = a.grid.dy() * y;
  a.height = topography::cell_means(a.height, x, y);
  a.grid.nx = a.height.cols();
  a.grid.ny = a.height.rows();
  if (a.grid.nx < 2 || a.grid.ny < 2) {
    throw InputError("combination of two scans", "a scan smaller than the other's pixels",
                     "scans of similar size", "check the pixel sizes");
  }
  a.grid.lx = dx * static_cast<double>(a.grid.nx);
  a.grid.ly = dy * static_cast<double>(a.grid.ny);
  a.periodic = false;
  a.history.push_back(fmt::format("averaged over pixels of {} x {}, those of the other scan",
                                  format_si(dx, "m"), format_si(dy, "m")));
  return a;
}

/// First and last row with a value.
std::pair<Index, Index> extent(const Eigen::Array<bool, Eigen::Dynamic, 1>& any) {
  Index first = 0, last = any.size() - 1;
  while (first < last && !any[first]) ++first;
  while (last > first && !any[last]) --last;
  return {first, last};
}

/// The smallest rectangle with all valid points.
topography::PixelWindow valid_window(const Field& map) {
  const Mask valid = !map.isNaN();
  const auto [top, bottom] = extent(valid.rowwise().any());
  const auto [left, right] = extent(valid.colwise().any().transpose());
  return {left, top, right - left + 1, bottom - top + 1};
}

/// Mean square of both maps about their means, and of their product.
struct CommonMoments {
  double n = 0;
  double variance_a = 0;
  double variance_b = 0;
  double covariance = 0;
};

CommonMoments common_moments(const Field& a, const Field& b) {
  const auto means = sum_over_rows<3>(a.rows(), [&](Index y) {
    const auto common = !(a.row(y) + b.row(y)).isNaN();
    return Eigen::Array3d(static_cast<double>(common.count()), common.select(a.row(y), 0).sum(),
                          common.select(b.row(y), 0).sum());
  });
  const double n = means[0], mean_a = means[1] / n, mean_b = means[2] / n;
  const auto sums = sum_over_rows<3>(a.rows(), [&](Index y) {
    const auto common = !(a.row(y) + b.row(y)).isNaN();
    const auto za = a.row(y) - mean_a, zb = b.row(y) - mean_b;
    return Eigen::Array3d(common.select(za.square(), 0).sum(), common.select(zb.square(), 0).sum(),
                          common.select(za * zb, 0).sum());
  });
  return {n, sums[0] / n, sums[1] / n, sums[2] / n};
}

void find_shift(const topography::Topography& a, const topography::Topography& b,
                const CombineOptions& options, Combination& result, const Observer& observer) {
  const bool composite = options.mode == CombineMode::composite;
  const bool given = options.shift_x || options.shift_y;
  if (!composite && !given && options.search) {
    result.registration = register_scans(a, b, options.registration, observer);
    result.shift_x = result.registration->shift_x;
    result.shift_y = result.registration->shift_y;
    return;
  }
  result.shift_x = options.shift_x.value_or(composite ? (b.grid.lx - a.grid.lx) / 2 : 0);
  result.shift_y = options.shift_y.value_or(composite ? (b.grid.ly - a.grid.ly) / 2 : 0);
}

/// What single precision, in which most files store heights, resolves of these about their mean
/// [m].
double resolution_of(const Field& height) {
  const numerics::FieldMoments moments = numerics::field_moments(height);
  return std::numeric_limits<float>::epsilon() * std::max(moments.highest, -moments.lowest);
}

RobustPlane plane_of(const Field& difference, LevelMatch match) {
  if (match == LevelMatch::none) return {.spread = robust_spread(difference)};
  RobustPlane plane = fit_robust_plane(difference);
  if (match == LevelMatch::offset) {
    // The robust mean: the height of the plane at the centre of the points, without its tilt.
    plane.offset +=
        numerics::mean_over(difference.rows(), difference.cols(), [&](Index y, Index x) {
          const double height = plane.tilt_x * across(x, difference.cols()) +
                                plane.tilt_y * across(y, difference.rows());
          return std::isnan(difference(y, x)) ? difference(y, x) : height;
        });
    plane.tilt_x = plane.tilt_y = 0;
    plane.spread = robust_spread(difference);
  }
  return plane;
}

/// The plane of the places that show no change: the rim of a scar bends one that is only robust.
/// What shows a change depends on the plane in turn.
RobustPlane plane_of_unchanged(const Field& difference, const Grid& grid,
                               const CombineOptions& options, double resolution) {
  constexpr int most_steps = 12;
  constexpr double fewest = 0.02;  // of the pixels; too few hold no plane
  RobustPlane plane = plane_of(difference, options.level);
  if (options.level == LevelMatch::none || !(plane.spread > 0)) return plane;
  Mask quiet;
  for (int step = 0; step < most_steps; ++step) {
    const Mask before = quiet;
    quiet =
        find_changes(remove_plane(difference, plane), grid, options.threshold, resolution).quiet;
    const auto n = static_cast<double>(quiet.count());
    const bool is_same = before.size() > 0 && (before == quiet).all();
    if (is_same || n < 9 || n < fewest * static_cast<double>(quiet.size())) break;
    plane =
        plane_of(quiet.select(difference, std::numeric_limits<double>::quiet_NaN()), options.level);
  }
  return plane;
}

std::string line_of(const Combination& c, const CombineOptions& options,
                    const topography::Topography& b) {
  const bool composite = options.mode == CombineMode::composite;
  return fmt::format("{} {} moved by {}, {}{}", composite ? "plus (turned over)" : "minus",
                     b.source, format_si(c.shift_x, "m"), format_si(c.shift_y, "m"),
                     composite ? "" : fmt::format(", level matched: {}", name_of(options.level)));
}

}  // namespace

std::optional<CombineMode> combine_mode_from(std::string_view name) { return kModes.find(name); }
std::string_view name_of(CombineMode mode) { return kModes.of(mode); }
std::optional<LevelMatch> level_match_from(std::string_view name) { return kMatches.find(name); }
std::string_view name_of(LevelMatch match) { return kMatches.of(match); }

Combination combine(const topography::Topography& first, const topography::Topography& second,
                    const CombineOptions& options, const Observer& observer) {
  const Watch watch(observer, "combine");
  const bool composite = options.mode == CombineMode::composite;
  const topography::Topography a = onto_coarser_pixels(first, second.grid);
  const topography::Topography b =
      composite ? topography::flip(second, topography::Axis::x) : second;
  Combination result;
  find_shift(a, b, options, result, observer);
  const Field moved = move_onto(b, a.grid, result.shift_x, result.shift_y);
  const CommonMoments moments = common_moments(a.height, moved);
  result.n_common = static_cast<Index>(moments.n);
  if (result.n_common < 9) {
    throw InputError("combination of two scans",
                     fmt::format("{} common points at a shift of {}, {}", result.n_common,
                                 format_si(result.shift_x, "m"), format_si(result.shift_y, "m")),
                     "scans that overlap",
                     "a shift is given as what lies at x in A lies at x + DX "
                     "in B");
  }
  result.rms_a = std::sqrt(moments.variance_a);
  result.rms_b = std::sqrt(moments.variance_b);
  result.correlation = moments.covariance / (result.rms_a * result.rms_b);
  const double resolution = std::max(resolution_of(a.height), resolution_of(moved));
  result.map = a;
  result.map.periodic = false;
  if (composite) {
    result.map.height = a.height + moved;
  } else {
    const Field difference = a.height - moved;
    result.plane = plane_of_unchanged(difference, a.grid, options, resolution);
    result.map.height = remove_plane(difference, result.plane);
  }
  result.map.history.push_back(line_of(result, options, b));
  // Replaces what the first scan's file says; `tabor cite` reads it from what is written.
  result.map.metadata["methods"] = result.registration ? "padfield2012" : "";
  result.map.source = first.source + (composite ? " + " : " - ") + second.source;
  const topography::PixelWindow window =
      valid_window(result.map.height);  // before the map is moved away
  result.map = topography::crop(std::move(result.map), window);
  const CommonMoments map_moments = common_moments(result.map.height, result.map.height);
  result.rms_map = std::sqrt(map_moments.variance_a);
  if (options.mode == CombineMode::wear) {
    result.wear = wear_volumes(result.map.height, result.map.grid,
                               {options.threshold, options.level, resolution});
  }
  return result;
}

}  // namespace tabor::comparison
