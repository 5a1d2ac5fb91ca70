#include "tabor/topography/spikes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
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

/// Pixels spread evenly over the scan, at most kSample of them: multiples of the golden ratio, so
/// that no column or texture is preferred.
std::vector<Index> sample_pixels(Index size) {
  constexpr Index kSample = Index{1} << 17;
  std::vector<Index> pixels(static_cast<std::size_t>(std::min(size, kSample)));
  for (std::size_t k = 0; k < pixels.size(); ++k) {
    const double turns = static_cast<double>(k) * (std::numbers::phi - 1);
    const double share = turns - std::floor(turns);
    pixels[k] = size <= kSample ? static_cast<Index>(k)
                                : static_cast<Index>(share * static_cast<double>(size));
  }
  return pixels;
}

/// Usual distance from the surroundings' median over the whole scan. Where more than half of the
/// heights equal theirs (coarsely digitised scans), the mean distance stands in.
double usual_distance(const Field& height, Index window) {
  const std::vector<Index> pixels = sample_pixels(height.size());
  std::vector<double> known(pixels.size());
  parallel_for(std::ssize(pixels), 1024, [&](Index begin, Index end) {
    std::vector<double> values;
    for (Index k = begin; k < end; ++k) {
      const Index pixel = pixels[static_cast<std::size_t>(k)];
      const Index y = pixel / height.cols(), x = pixel % height.cols();
      known[static_cast<std::size_t>(k)] =
          std::abs(height(y, x) - around(height, y, x, window, values).median);
    }
  });
  std::erase_if(known, [](double distance) { return std::isnan(distance); });
  if (known.empty()) {
    return std::numeric_limits<double>::infinity();
  }
  const double mean =
      std::accumulate(known.begin(), known.end(), 0.0) / static_cast<double>(known.size());
  const double middle = median(known);
  return middle > 0 ? kSigmaOfMad * middle : mean * std::sqrt(std::numbers::pi / 2);
}

/// Decides about one height after the other.
class SpikeTest {
 public:
  SpikeTest(const Field& height, const SpikeRule& rule)
      : height_(height),
        rule_(rule),
        limit_(rule.threshold * usual_distance(height, rule.window)) {}

  /// `values` is room to work in.
  bool operator()(Index y, Index x, std::vector<double>& values) const {
    if (std::isnan(height_(y, x)) || most_neighbours_are_near(y, x)) {
      return false;
    }
    const Surroundings s = around(height_, y, x, rule_.window, values);
    const double distance = std::abs(height_(y, x) - s.median);  // NaN: too few neighbours
    return distance > limit_ && distance > rule_.threshold * s.spread;
  }

 private:
  /// Then their median is near as well. This spares nearly all heights the sorting.
  bool most_neighbours_are_near(Index y, Index x) const {
    const Index reach = rule_.window / 2;
    const Index left = std::max<Index>(0, x - reach);
    const Index right = std::min(height_.cols() - 1, x + reach);
    Index n_near = -1, n = -1;  // the height itself does not count
    for (Index v = std::max<Index>(0, y - reach); v <= std::min(height_.rows() - 1, y + reach);
         ++v) {
      for (Index u = left; u <= right; ++u) {
        n_near += std::abs(height_(y, x) - height_(v, u)) <= limit_ ? 1 : 0;
        n += std::isnan(height_(v, u)) ? 0 : 1;
      }
    }
    return 2 * n_near > n;
  }

  const Field& height_;
  SpikeRule rule_;
  double limit_;  ///< [m]
};

void check(const SpikeRule& rule) {
  if (!(rule.threshold > 0) || !std::isfinite(rule.threshold)) {
    throw InputError("despike", fmt::format("a threshold of {}", rule.threshold),
                     "a positive number of standard deviations", "e.g. despike=8");
  }
  if (rule.window < 3 || rule.window > kLargestWindow || rule.window % 2 == 0) {
    throw InputError("despike", fmt::format("a window of {} pixels", rule.window),
                     fmt::format("an odd number from 3 to {}", kLargestWindow), "e.g. despike=8,5");
  }
}

}  // namespace

SpikeRule parse_spike_rule(std::string_view text) {
  SpikeRule rule;
  const auto parts = split(std::string(text), ',');
  const auto refuse = [&] {
    throw InputError("despike", text.empty() ? "no value" : fmt::format("'{}'", text),
                     "auto, or SIGMAS[,WINDOW[,hole|median]]", "e.g. despike=8,5,median");
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
  const SpikeTest is_spike(height, rule);
  Mask spikes(height.rows(), height.cols());
  for_each_row(height.rows(), [&](Index y) {
    std::vector<double> values;
    for (Index x = 0; x < height.cols(); ++x) {
      spikes(y, x) = is_spike(y, x, values);
    }
  });
  return spikes;
}

Index count_spikes(const Field& height, const SpikeRule& rule) {
  check(rule);
  const SpikeTest is_spike(height, rule);
  const auto n = sum_over_rows<1>(height.rows(), [&](Index y) {
    std::vector<double> values;
    double n_in_row = 0;
    for (Index x = 0; x < height.cols(); ++x) {
      n_in_row += is_spike(y, x, values) ? 1 : 0;
    }
    return Eigen::Array<double, 1, 1>(n_in_row);
  });
  return static_cast<Index>(n[0]);
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
    topography.doubts.push_back(fmt::format("despike took {} spike{} out of {} heights", n_spikes,
                                            n_spikes == 1 ? "" : "s", spikes.size()));
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
