#include "tabor/metrology/areal/abbott.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "tabor/core/parallel.hpp"
#include "tabor/core/watch.hpp"
#include "tabor/numerics/field_statistics.hpp"

namespace tabor::metrology {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kCoreShare = 0.4;  ///< of the curve, ISO 13565-2

/// Height of the right triangle over the share `ratio` [%] with the mean height `volume` over all.
double reduced_height(double volume, double ratio) {
  return ratio > 0 ? 2 * 100 * volume / ratio : 0;
}

}  // namespace

AbbottCurve::AbbottCurve(const Field& height, const Observer& observer) {
  const Watch watch(observer, "material ratio curve");
  const numerics::FieldMoments moments = numerics::field_moments(height);
  heights_ = falling_heights(height, moments.n, moments.mean, observer);
  rounding_ = numerics::rounding_of(std::abs(moments.mean) +
                                    std::max(std::abs(highest()), std::abs(lowest())));
}

/// Where the secant over `width` heights falls least, the first of those equal but for rounding.
Index AbbottCurve::flattest_secant(Index width) const {
  const Index n = size() - width;
  const auto fall = [&](Index i) {
    return heights_[static_cast<std::size_t>(i)] - heights_[static_cast<std::size_t>(i + width)];
  };
  std::vector<double> blocks(static_cast<std::size_t>((n + kBlock - 1) / kBlock),
                             std::numeric_limits<double>::infinity());
  parallel_for(n, kBlock, [&](Index begin, Index end) {
    double& least = blocks[static_cast<std::size_t>(begin / kBlock)];
    for (Index i = begin; i < end; ++i) least = std::min(least, fall(i));
  });
  const double least = *std::min_element(blocks.begin(), blocks.end()) + rounding_;
  Index block = 0;
  while (blocks[static_cast<std::size_t>(block)] > least) ++block;
  Index start = block * kBlock;
  while (fall(start) > least) ++start;
  return start;
}

std::pair<AbbottCurve::Place, AbbottCurve::Place> AbbottCurve::equal_to(double height) const {
  return {std::lower_bound(heights_.begin(), heights_.end(), height + rounding_, std::greater<>()),
          std::upper_bound(heights_.begin(), heights_.end(), height - rounding_, std::greater<>())};
}

/// Share above a height that lies between the one before `first` and that one. [%]
double AbbottCurve::ratio_between(Place first, double height) const {
  if (first == heights_.begin()) return 0;
  if (first == heights_.end()) return 100;
  const double upper = *(first - 1);
  const auto above = static_cast<double>(first - heights_.begin());
  return 100 * (above - 0.5 + (upper - height) / (upper - *first)) /
         static_cast<double>(heights_.size());
}

double AbbottCurve::height_at(double percent) const {
  const double place = percent / 100 * static_cast<double>(heights_.size()) - 0.5;
  const double inside = std::clamp(place, 0.0, static_cast<double>(heights_.size() - 1));
  const auto before = static_cast<std::size_t>(inside);
  const std::size_t after = std::min(before + 1, heights_.size() - 1);
  const double share = inside - static_cast<double>(before);
  return heights_[before] + share * (heights_[after] - heights_[before]);
}

double AbbottCurve::ratio_above(double height) const {
  const auto [first, last] = equal_to(height);
  if (first == last) return ratio_between(first, height);
  const auto above = static_cast<double>(first - heights_.begin());
  return 100 * (above + static_cast<double>(last - first) / 2) /
         static_cast<double>(heights_.size());
}

double AbbottCurve::material_above(double height) const {
  const auto end = std::lower_bound(heights_.begin(), heights_.end(), height, std::greater<>());
  return deterministic_sum(end - heights_.begin(),
                           [&](Index begin, Index stop) {
                             double total = 0;
                             for (Index i = begin; i < stop; ++i) {
                               total += heights_[static_cast<std::size_t>(i)] - height;
                             }
                             return total;
                           }) /
         static_cast<double>(heights_.size());
}

double AbbottCurve::void_below(double height) const {
  const auto start = std::upper_bound(heights_.begin(), heights_.end(), height, std::greater<>());
  const Index offset = start - heights_.begin();
  return deterministic_sum(size() - offset,
                           [&](Index begin, Index stop) {
                             double total = 0;
                             for (Index i = offset + begin; i < offset + stop; ++i) {
                               total += height - heights_[static_cast<std::size_t>(i)];
                             }
                             return total;
                           }) /
         static_cast<double>(heights_.size());
}

CoreLine AbbottCurve::core_line() const {
  if (size() < 2) return {kNan, kNan};
  const Index width =
      std::clamp<Index>(std::llround(kCoreShare * static_cast<double>(size())), 1, size() - 1);
  const Index start = flattest_secant(width);
  const auto n = static_cast<double>(width + 1);
  const double middle = static_cast<double>(width) / 2;
  // About one of the heights: a plateau is at its height without rounding.
  const double level = heights_[static_cast<std::size_t>(start)];
  const auto sum_of = [&](const auto& term) {
    return deterministic_sum(width + 1, [&](Index begin, Index end) {
      double total = 0;
      for (Index i = begin; i < end; ++i) {
        total += term(static_cast<double>(i) - middle,
                      heights_[static_cast<std::size_t>(start + i)] - level);
      }
      return total;
    });
  };
  const double mean = sum_of([](double, double z) { return z; }) / n;
  const double slope = sum_of([&](double x, double z) { return x * (z - mean); }) /
                       sum_of([](double x, double) { return x * x; });
  // The heights lie at the middles of their shares: 0 % is half a place before the first.
  const double centre = static_cast<double>(start) + middle + 0.5;
  const double upper = level + mean - slope * centre;
  return {upper, upper + slope * static_cast<double>(size())};
}

Core AbbottCurve::core() const {
  Core core;
  core.line = core_line();
  if (size() < 2) return {core.line, kNan, kNan, kNan, kNan, kNan};
  const auto [upper, upper_end] = equal_to(core.line.upper);
  const auto [lower, lower_end] = equal_to(core.line.lower);
  const auto share = [&](Place end) {
    return 100 * static_cast<double>(end - heights_.begin()) / static_cast<double>(heights_.size());
  };
  core.height = core.line.upper - core.line.lower;
  core.peak_ratio = upper == upper_end ? ratio_between(upper, core.line.upper) : share(upper);
  core.dale_ratio = lower == lower_end ? ratio_between(lower, core.line.lower) : share(lower_end);
  core.peak_height = reduced_height(material_above(core.line.upper), core.peak_ratio);
  core.dale_height = reduced_height(void_below(core.line.lower), 100 - core.dale_ratio);
  return core;
}

}  // namespace tabor::metrology
