#include "tabor/scan/formats/profile.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "tabor/core/units.hpp"

namespace tabor::scan::format {
namespace {

using Numbers = std::vector<double>;

/// Smallest and largest distance between neighbours.
std::pair<double, double> steps_of(const Numbers& positions) {
  double least = positions[1] - positions[0];
  double most = least;
  for (std::size_t i = 2; i < positions.size(); ++i) {
    const double step = positions[i] - positions[i - 1];
    least = std::min(least, step);
    most = std::max(most, step);
    if (std::isnan(step)) return {step, step};
  }
  return {least, most};
}

bool is_even(const Numbers& positions, double step) {
  constexpr double kMostOff = 0.05;  // steps, as for coordinates in text files
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const double even = positions.front() + static_cast<double>(i) * step;
    if (!(std::abs(positions[i] - even) <= kMostOff * step)) return false;
  }
  return true;
}

/// Linear interpolation; a hole where either neighbour is one.
Numbers interpolated(const Numbers& positions, const Numbers& heights, double step) {
  Numbers even(heights.size());
  std::size_t right = 1;
  for (std::size_t i = 0; i < even.size(); ++i) {
    const double place =
        std::min(positions.front() + static_cast<double>(i) * step, positions.back());
    while (positions[right] < place) ++right;
    const double share = (place - positions[right - 1]) / (positions[right] - positions[right - 1]);
    even[i] = share == 0   ? heights[right - 1]
              : share == 1 ? heights[right]
                           : (1 - share) * heights[right - 1] + share * heights[right];
  }
  return even;
}

}  // namespace

EvenProfile even_profile(const Contents& contents, Numbers positions, Numbers heights) {
  if (positions.size() != heights.size() || positions.size() < 2) {
    reject(contents, fmt::format("{} positions and {} heights", positions.size(), heights.size()),
           "a profile of at least two points", kDamaged);
  }
  if (positions.back() < positions.front()) {
    std::reverse(positions.begin(), positions.end());
    std::reverse(heights.begin(), heights.end());
  }
  const auto [least, most] = steps_of(positions);
  const double step =
      (positions.back() - positions.front()) / static_cast<double>(positions.size() - 1);
  if (!(least > 0) || !std::isfinite(step)) {
    reject(contents, "positions that neither rise nor fall throughout", "a profile",
           "take out repeated and missing positions");
  }
  EvenProfile profile{.heights = {}, .step = step};
  if (!is_even(positions, step)) {
    heights = interpolated(positions, heights, step);
    profile.warning = fmt::format(
        "the positions have steps from {:.3g} to {:.3g}: the heights were interpolated to even "
        "steps of {:.3g}",
        least, most, step);
  }
  profile.heights = Eigen::Map<const Field>(heights.data(), 1, static_cast<Index>(heights.size()));
  return profile;
}

Layer profile_layer(EvenProfile profile, const std::string& unit_x, const std::string& unit_z,
                    Document& document) {
  if (!profile.warning.empty()) {
    document.warnings.push_back(profile.warning + (unit_x.empty() ? "" : " " + unit_x));
  }
  const auto heights = std::make_shared<const Field>(std::move(profile.heights));
  Layer layer{.name = "profile", .unit = unit_z, .nx = heights->cols(), .ny = 1};
  if (!unit_x.empty()) {
    layer.pixel_x = profile.step * unit_factor(unit_x, dimension::length).value_or(kHole);
    layer.pixel_y = layer.pixel_x;
    layer.said_x = layer.said_y = fmt::format("a step of {:g} {}", profile.step, unit_x);
  }
  layer.load = [heights] { return *heights; };
  return layer;
}

}  // namespace tabor::scan::format
