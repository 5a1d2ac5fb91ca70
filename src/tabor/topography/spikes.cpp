#include "tabor/topography/spikes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "tabor/core/error.hpp"
#include "tabor/core/text.hpp"
#include "tabor/topography/rows.hpp"

namespace tabor::topography {
namespace {

/// Standard deviation of a Gaussian over its median absolute deviation, 1 / Phi^-1(3/4).
constexpr double kSigmaOfMad = 1.482602218505602;
constexpr std::size_t kFewestNeighbours = 5;
constexpr Index kLargestWindow = 99;

/// Upper median; reorders the values.
template <typename Real>
Real median(std::vector<Real>& values) {
  const auto middle = values.begin() + std::ssize(values) / 2;
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Median and robust standard deviation of the valid heights around a pixel, itself left out.
struct Surroundings {
  double median = std::numeric_limits<double>::quiet_NaN();  ///< NaN: too few neighbours
  double spread = 0;
};

Surroundings around(const Field& height, Index y, Index x, Index window,
                    std::vector<double>& values) {
  const Index reach = window / 2;
  values.clear();
  for (Index v = std::max<Index>(0, y - reach); v <= std::min(height.rows() - 1, y + reach); ++v) {
    for (Index u = std::max<Index>(0, x - reach); u <= std::min(height.cols() - 1, x + reach);
         ++u) {
      if ((v != y || u != x) && !std::isnan(height(v, u))) {
        values.push_back(height(v, u));
      }
    }
  }
  if (values.size() < kFewestNeighbours) {
    return {};
  }
  const double middle = median(values);
  for (double& value : values) {
    value = std::abs(value - middle);
  }
  return {middle, kSigmaOfMad * median(values)};
}

/// Calls found(y, x, surroundings) for every valid height with enough neighbours.
template <typename Found>
void for_each_height(const Field& height, Index window, const Found& found) {
  for_each_row(height.rows(), [&](Index y) {
    std::vector<double> values;
    for (Index x = 0; x < height.cols(); ++x) {
      if (!std::isnan(height(y, x))) {
        const Surroundings surroundings = around(height, y, x, window, values);
        if (!std::isnan(surroundings.median)) {
          found(y, x, surroundings);
        }
      }
    }
  });
}

/// Usual distance from the surroundings' median over the whole scan. Where more than half of the
/// heights equal theirs (coarsely digitised scans), the mean distance stands in.
double usual_distance(const FieldF& distances) {
  std::vector<float> known;
  known.reserve(static_cast<std::size_t>(distances.size()));
  double sum = 0;
  for (Index i = 0; i < distances.size(); ++i) {
    if (!std::isnan(distances.data()[i])) {
      known.push_back(distances.data()[i]);
      sum += static_cast<double>(distances.data()[i]);
    }
  }
  if (known.empty()) {
    return std::numeric_limits<double>::infinity();
  }
  const double mean = sum / static_cast<double>(known.size());
  const auto middle = static_cast<double>(median(known));
  return middle > 0 ? kSigmaOfMad * middle : mean * std::sqrt(std::acos(-1.0) / 2);
}

void check(const SpikeRule& rule) {
  if (!(rule.threshold > 0) || !std::isfinite(rule.threshold)) {
    throw InputError("despike", fmt::format("a threshold of {}", rule.threshold),
                     "a positive number of standard deviations", "e.g. despike=6");
  }
  if (rule.window < 3 || rule.window > kLargestWindow || rule.window % 2 == 0) {
    throw InputError("despike", fmt::format("a window of {} pixels", rule.window),
                     fmt::format("an odd number from 3 to {}", kLargestWindow), "e.g. despike=6,5");
  }
}

}  // namespace

SpikeRule parse_spike_rule(std::string_view text) {
  SpikeRule rule;
  const auto parts = split(std::string(text), ',');
  const auto refuse = [&] {
    throw InputError("despike", text.empty() ? "no value" : fmt::format("'{}'", text),
                     "auto, or SIGMAS[,WINDOW[,hole|median]]", "e.g. despike=6,5,median");
  };
  if (text.empty() || parts.size() > 3) {
    refuse();
  }
  if (trim(parts[0]) != "auto") {
    const auto threshold = parse_number(trim(parts[0]));
    threshold ? void(rule.threshold = *threshold) : refuse();
  }
  if (parts.size() > 1) {
    const auto window = parse_number(trim(parts[1]));
    if (!window || *window != std::round(*window) || std::abs(*window) > 1e6) {
      refuse();
    }
    rule.window = static_cast<Index>(*window);
  }
  if (parts.size() > 2) {
    rule.fill_with_median = trim(parts[2]) == "median";
    if (!rule.fill_with_median && trim(parts[2]) != "hole") {
      refuse();
    }
  }
  check(rule);
  return rule;
}

Mask find_spikes(const Field& height, const SpikeRule& rule) {
  check(rule);
  constexpr float unknown = std::numeric_limits<float>::quiet_NaN();
  FieldF distances = FieldF::Constant(height.rows(), height.cols(), unknown);
  Mask candidates = Mask::Constant(height.rows(), height.cols(), false);
  for_each_height(height, rule.window, [&](Index y, Index x, const Surroundings& s) {
    const double distance = std::abs(height(y, x) - s.median);
    distances(y, x) = static_cast<float>(distance);
    candidates(y, x) = distance > rule.threshold * s.spread;
  });
  const double limit = rule.threshold * usual_distance(distances);
  for_each_row(height.rows(), [&](Index y) {
    candidates.row(y) = candidates.row(y) && distances.row(y).cast<double>() > limit;
  });
  return candidates;
}

Topography remove_spikes(Topography topography, const SpikeRule& rule) {
  const Mask spikes = find_spikes(topography.height, rule);
  const Field& before = topography.height;
  Field after = before;
  Index n_spikes = 0;
  double largest = 0;
  std::vector<double> values;
  for (Index i = 0; i < spikes.size(); ++i) {
    if (spikes.data()[i]) {
      const Index y = i / spikes.cols(), x = i % spikes.cols();
      const double middle = around(before, y, x, rule.window, values).median;
      largest = std::max(largest, std::abs(before(y, x) - middle));
      after(y, x) = rule.fill_with_median ? middle : std::numeric_limits<double>::quiet_NaN();
      ++n_spikes;
    }
  }
  topography.height = std::move(after);
  if (n_spikes > 0) {
    topography.doubts.push_back(
        fmt::format("despike took {} spikes out of {} heights", n_spikes, spikes.size()));
  }
  topography.history.push_back(fmt::format(
      "despike={},{},{}: {} of {} heights ({:.3g} %) were spikes and became {}{}", rule.threshold,
      rule.window, rule.fill_with_median ? "median" : "hole", n_spikes, spikes.size(),
      100 * static_cast<double>(n_spikes) / static_cast<double>(spikes.size()),
      rule.fill_with_median ? "the median around them" : "holes",
      n_spikes > 0 ? fmt::format("; the largest stood {:.4g} um out", 1e6 * largest) : ""));
  return topography;
}

}  // namespace tabor::topography
