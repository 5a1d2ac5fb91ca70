#include "tabor/topography/spikes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "tabor/core/error.hpp"
#include "tabor/core/rows.hpp"
#include "tabor/core/text.hpp"
#include "tabor/numerics/medians.hpp"

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

/// Length of the window's sides. A profile has fewer neighbours: there it is `window` heights on
/// either side, so that the first and last have enough.
Index window_side(const Field& height, const SpikeRule& rule) {
  const bool is_profile = height.rows() == 1 || height.cols() == 1;
  return is_profile ? 2 * rule.window + 1 : rule.window;
}

/// The valid heights around a pixel, itself left out; none where there are too few.
void take_neighbours(const Field& height, Index y, Index x, Index window,
                     std::vector<double>& values) {
  const Index reach = window / 2;
  values.clear();
  for (Index v = std::max<Index>(0, y - reach); v <= std::min(height.rows() - 1, y + reach); ++v) {
    for (Index u = std::max<Index>(0, x - reach); u <= std::min(height.cols() - 1, x + reach);
         ++u) {
      if ((v != y || u != x) && !std::isnan(height(v, u))) values.push_back(height(v, u));
    }
  }
  if (values.size() < kFewestNeighbours) values.clear();
}

/// Median of the heights around a pixel; NaN where there are too few. `values` is scratch memory.
double median_around(const Field& height, Index y, Index x, Index window,
                     std::vector<double>& values) {
  take_neighbours(height, y, x, window, values);
  return values.empty() ? std::numeric_limits<double>::quiet_NaN() : median(values);
}

/// Robust standard deviation of values about their median; reorders and changes them.
double spread_about(double middle, std::vector<double>& values) {
  for (double& value : values) value = std::abs(value - middle);
  return kSigmaOfMad * median(values);
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

/// Medians around pixels, several at once where they have all their neighbours.
class MediansAround {
 public:
  MediansAround(const Field& height, Index window) : height_(height), window_(window) {}

  /// Calls take(k, median) for each pixels[k]; NaN where there are too few neighbours.
  template <typename Take>
  void find(std::span<const Index> pixels, const Take& take) {
    constexpr std::size_t n_side = kLanes;
    std::size_t n_waiting = 0;
    std::array<std::size_t, n_side> waiting{};
    for (std::size_t k = 0; k < pixels.size(); ++k) {
      if (!has_all_neighbours(pixels[k])) {
        const Index y = pixels[k] / height_.cols(), x = pixels[k] % height_.cols();
        take(k, median_around(height_, y, x, window_, values_));
        continue;
      }
      waiting[n_waiting++] = k;
      if (n_waiting == n_side) take_waiting(pixels, waiting, std::exchange(n_waiting, 0), take);
    }
    if (n_waiting > 0) take_waiting(pixels, waiting, n_waiting, take);
  }

 private:
  /// One median after the other is faster where windows are wider: side by side they take the
  /// square of the neighbours.
  static constexpr Index kWidest = 7;

  bool has_all_neighbours(Index pixel) const {
    if (window_ > kWidest) return false;
    const Index reach = window_ / 2;
    const Index y = pixel / height_.cols(), x = pixel % height_.cols();
    if (y < reach || x < reach || y + reach >= height_.rows() || x + reach >= height_.cols()) {
      return false;
    }
    return height_.block(y - reach, x - reach, window_, window_).isFinite().all();
  }

  /// Takes the medians of the first n that wait; the last of them stands in for the missing.
  template <typename Take>
  void take_waiting(std::span<const Index> pixels, std::span<const std::size_t> waiting,
                    std::size_t n, const Take& take) {
    lanes_.resize(static_cast<std::size_t>(window_ * window_ - 1));
    const Index reach = window_ / 2;
    for (std::size_t i = 0; i < kLanes; ++i) {
      const double* centre = height_.data() + pixels[waiting[std::min(i, n - 1)]];
      std::size_t j = 0;
      for (Index v = -reach; v <= reach; ++v) {
        for (Index u = -reach; u <= reach; ++u) {
          if (v != 0 || u != 0) lanes_[j++][i] = centre[v * height_.cols() + u];
        }
      }
    }
    const Lanes& medians = numerics::upper_medians(lanes_);
    for (std::size_t i = 0; i < n; ++i) take(waiting[i], medians[i]);
  }

  const Field& height_;
  Index window_;
  std::vector<double> values_;
  std::vector<Lanes> lanes_;
};

/// Typical distance from the surroundings' median over the whole scan. Where more than half of the
/// heights equal theirs (coarsely digitised scans), the mean distance stands in.
double typical_distance(const Field& height, Index window) {
  const std::vector<Index> pixels = sample_pixels(height.size());
  std::vector<double> known(pixels.size());
  parallel_for(std::ssize(pixels), 1024, [&](Index begin, Index end) {
    const auto first = static_cast<std::size_t>(begin);
    const std::span<const Index> part(pixels.data() + first, static_cast<std::size_t>(end - begin));
    MediansAround(height, window).find(part, [&](std::size_t k, double median) {
      known[first + k] = std::abs(height.data()[part[k]] - median);
    });
  });
  std::erase_if(known, [](double distance) { return std::isnan(distance); });
  if (known.empty()) return std::numeric_limits<double>::infinity();
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
        threshold_(rule.threshold),
        window_(window_side(height, rule)),
        limit_(threshold_ * typical_distance(height, window_)) {}

  /// Calls action(x) for the spikes of row y.
  template <typename Action>
  void for_spikes(Index y, const Action& action) const {
    const Index reach = window_ / 2;
    std::vector<double> values;
    const auto look = [&](Index x) {
      if (is_spike(y, x, values)) action(x);
    };
    Index x = 0;
    while (x < height_.cols()) {
      const bool at_edge = x < reach || x + kSide + reach > height_.cols();
      if (at_edge) {
        look(x++);
        continue;
      }
      const std::array<double, kSide> n_near = near_neighbours(y, x);
      for (const double n : n_near) {
        if (2 * n <= most_neighbours()) look(x);
        ++x;
      }
    }
  }

 private:
  /// Heights looked at side by side, by vector instructions.
  static constexpr Index kSide = 16;

  double most_neighbours() const { return static_cast<double>(window_ * window_ - 1); }

  /// How many of their neighbours are near the heights from (y, x) on; fewer where more than half
  /// of them are already found to be. This spares nearly all heights a closer look.
  std::array<double, kSide> near_neighbours(Index y, Index x) const {
    const Index reach = window_ / 2;
    std::array<double, kSide> n_near;
    n_near.fill(-1);  // the height itself does not count
    const double* z = &height_(y, x);
    const auto count_row = [&](Index v) {
      if (v < 0 || v >= height_.rows()) return;
      for (Index u = x - reach; u <= x + reach; ++u) count_near(z, &height_(v, u), n_near);
    };
    count_row(y);
    for (Index k = 1; k <= reach; ++k) {
      count_row(y - k);
      count_row(y + k);
      if (2 * *std::min_element(n_near.begin(), n_near.end()) > most_neighbours()) break;
    }
    return n_near;
  }

  void count_near(const double* z, const double* other, std::array<double, kSide>& n_near) const {
    for (std::size_t i = 0; i < n_near.size(); ++i) {
      n_near[i] += std::abs(z[i] - other[i]) <= limit_ ? 1 : 0;
    }
  }

  /// `values` is scratch memory.
  bool is_spike(Index y, Index x, std::vector<double>& values) const {
    if (std::isnan(height_(y, x)) || most_neighbours_are_near(y, x)) return false;
    const double middle = median_around(height_, y, x, window_, values);
    const double distance = std::abs(height_(y, x) - middle);  // NaN: too few neighbours
    return distance > limit_ && distance > threshold_ * spread_about(middle, values);
  }

  /// Then their median is near as well. This spares nearly all heights the sorting.
  bool most_neighbours_are_near(Index y, Index x) const {
    const Index reach = window_ / 2;
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
  double threshold_;
  Index window_;
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
  const auto reject = [&] {
    throw InputError("despike", text.empty() ? "no value" : fmt::format("'{}'", text),
                     "auto, or SIGMAS[,WINDOW[,hole|median]]", "e.g. despike=8,5,median");
  };
  if (text.empty() || parts.size() > 3) reject();
  if (trim(parts[0]) != "auto") {
    const auto threshold = parse_number(trim(parts[0]));
    threshold ? void(rule.threshold = *threshold) : reject();
  }
  if (parts.size() > 1) {
    const auto window = parse_number(trim(parts[1]));
    if (!window || *window != std::round(*window) || std::abs(*window) > 1e6) reject();
    rule.window = static_cast<Index>(*window);
  }
  if (parts.size() > 2) {
    rule.fill_with_median = trim(parts[2]) == "median";
    if (!rule.fill_with_median && trim(parts[2]) != "hole") reject();
  }
  check(rule);
  return rule;
}

Mask find_spikes(const Field& height, const SpikeRule& rule) {
  check(rule);
  const SpikeTest test(height, rule);
  Mask spikes = Mask::Constant(height.rows(), height.cols(), false);
  for_each_row(height.rows(),
               [&](Index y) { test.for_spikes(y, [&](Index x) { spikes(y, x) = true; }); });
  return spikes;
}

Index count_spikes(const Field& height, const SpikeRule& rule) {
  check(rule);
  const SpikeTest test(height, rule);
  const auto n = sum_over_rows<1>(height.rows(), [&](Index y) {
    double n_in_row = 0;
    test.for_spikes(y, [&](Index) { ++n_in_row; });
    return Eigen::Array<double, 1, 1>(n_in_row);
  });
  return static_cast<Index>(n[0]);
}

namespace {

/// A further pass, and the spikes that it would take beside those that are taken already.
struct FurtherPass {
  SpikeRule rule;
  Index n_beside = 0;
};

/// The same rule through its own window and wider ones: heights that stand together fill more than
/// half of a window and hide each other in it.
std::vector<SpikeRule> further_rules(const SpikeRule& rule) {
  std::vector<SpikeRule> rules;
  for (const Index more : {0, 2, 4}) {
    SpikeRule other = rule;
    other.window = rule.window + more;
    if (other.window <= kLargestWindow) rules.push_back(other);
  }
  return rules;
}

bool is_near(const Mask& taken, Index y, Index x, Index reach) {
  const Index top = std::max<Index>(0, y - reach), left = std::max<Index>(0, x - reach);
  const Index bottom = std::min(taken.rows() - 1, y + reach);
  const Index right = std::min(taken.cols() - 1, x + reach);
  return taken.block(top, left, bottom - top + 1, right - left + 1).any();
}

/// The spikes with one of those taken inside their window that touch it, by a side or a corner, or
/// another such spike.
Index count_touching(const Mask& spikes, const Mask& taken, Index window) {
  Mask touching = Mask::Constant(spikes.rows(), spikes.cols(), false);
  std::vector<Index> next;
  Index n = 0;
  const auto spread_from = [&](Index pixel) {
    const Index y = pixel / spikes.cols(), x = pixel % spikes.cols();
    for (Index v = std::max<Index>(0, y - 1); v <= std::min(spikes.rows() - 1, y + 1); ++v) {
      for (Index u = std::max<Index>(0, x - 1); u <= std::min(spikes.cols() - 1, x + 1); ++u) {
        if (!spikes(v, u) || touching(v, u) || !is_near(taken, v, u, window / 2)) continue;
        touching(v, u) = true;
        next.push_back(v * spikes.cols() + u);
        ++n;
      }
    }
  };
  for (Index pixel = 0; pixel < taken.size(); ++pixel) {
    if (!taken.data()[pixel]) continue;
    spread_from(pixel);
    while (!next.empty()) {
      const Index last = next.back();
      next.pop_back();
      spread_from(last);
    }
  }
  return n;
}

/// The pass that takes the most of what stands together with the spikes taken, the narrowest window
/// of equal ones; none where most of what it takes stands elsewhere: a wider window takes ridges
/// for spikes.
FurtherPass best_pass(const Field& after, const Mask& taken, const SpikeRule& rule) {
  FurtherPass best;
  if (!taken.any()) return best;
  for (const SpikeRule& other : further_rules(rule)) {
    const Mask spikes = find_spikes(after, other);
    const Index n_beside = count_touching(spikes, taken, other.window);
    if (2 * n_beside >= spikes.count() && n_beside > best.n_beside) best = {other, n_beside};
  }
  return best;
}

std::string text_of(const SpikeRule& rule) {
  return fmt::format("despike={},{}{}", rule.threshold, rule.window,
                     rule.fill_with_median ? ",median" : "");
}

/// Spikes that stand together, which a further pass takes.
void look_again(const Field& after, const Mask& taken, const SpikeRule& rule, Warnings& list) {
  const auto [further, n] = best_pass(after, taken, rule);
  if (n == 0) return;
  list.push_back(
      {.code = "spikes",
       .text = fmt::format("{} left after a window of {} pixels, because neighbouring spikes hide "
                           "each other; another <{}> removes {}",
                           n == 1 ? std::string("1 spike is") : fmt::format("{} spikes are", n),
                           rule.window, text_of(further), n == 1 ? "it" : "them")});
}

}  // namespace

Topography remove_spikes(Topography topography, const SpikeRule& rule) {
  std::erase_if(topography.warnings,
                [](const Warning& warning) { return warning.code == "spikes"; });
  const Mask spikes = find_spikes(topography.height, rule);
  const Field& before = topography.height;
  Field after = before;
  Index n_spikes = 0;
  double largest = 0;
  std::vector<double> values;
  for (Index i = 0; i < spikes.size(); ++i) {
    if (spikes.data()[i]) {
      const Index y = i / spikes.cols(), x = i % spikes.cols();
      const double middle = median_around(before, y, x, window_side(before, rule), values);
      largest = std::max(largest, std::abs(before(y, x) - middle));
      after(y, x) = rule.fill_with_median ? middle : std::numeric_limits<double>::quiet_NaN();
      ++n_spikes;
    }
  }
  look_again(after, spikes, rule, topography.warnings);
  const Index n_heights = spikes.size() - count_holes(topography);
  topography.height = std::move(after);
  if (n_spikes > 0) {
    topography.warnings.push_back(
        {.code = "despiked",
         .text = fmt::format("despike took {} spike{} out of {} heights", n_spikes,
                             n_spikes == 1 ? "" : "s", n_heights)});
  }
  topography.history.push_back(fmt::format(
      "despike={},{},{}: {} of {} heights ({:.3g} %) were spikes and became {}{}", rule.threshold,
      rule.window, rule.fill_with_median ? "median" : "hole", n_spikes, n_heights,
      n_spikes == 0 ? 0 : 100 * static_cast<double>(n_spikes) / static_cast<double>(n_heights),
      rule.fill_with_median ? "the median around them" : "holes",
      n_spikes > 0 ? fmt::format("; the largest stood {:.4g} um out", 1e6 * largest) : ""));
  return topography;
}

}  // namespace tabor::topography
