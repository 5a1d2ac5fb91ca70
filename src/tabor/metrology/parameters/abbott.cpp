#include "tabor/metrology/parameters/abbott.hpp"

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

/// Where the secant over `width` heights falls least, the first of equal ones.
Index flattest_secant(const std::vector<double>& heights, Index width) {
  struct Least {
    double fall = std::numeric_limits<double>::infinity();
    Index start = 0;
  };
  const Index n = static_cast<Index>(heights.size()) - width;
  std::vector<Least> blocks(static_cast<std::size_t>((n + kBlock - 1) / kBlock));
  parallel_for(n, kBlock, [&](Index begin, Index end) {
    Least& least = blocks[static_cast<std::size_t>(begin / kBlock)];
    for (Index i = begin; i < end; ++i) {
      const double fall =
          heights[static_cast<std::size_t>(i)] - heights[static_cast<std::size_t>(i + width)];
      if (fall < least.fall) least = {fall, i};
    }
  });
  return std::min_element(blocks.begin(), blocks.end(),
                          [](const Least& a, const Least& b) { return a.fall < b.fall; })
      ->start;
}

}  // namespace

AbbottCurve::AbbottCurve(const Field& height, const Observer& observer) {
  const Watch watch(observer, "material ratio curve");
  const numerics::FieldMoments moments = numerics::field_moments(height);
  heights_ = falling_heights(height, moments.n, moments.mean, observer);
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
  const auto [first, last] =
      std::equal_range(heights_.begin(), heights_.end(), height, std::greater<>());
  const auto above = static_cast<double>(first - heights_.begin());
  const auto n = static_cast<double>(heights_.size());
  if (first != last) return 100 * (above + static_cast<double>(last - first) / 2) / n;
  if (first == heights_.begin()) return 0;
  if (first == heights_.end()) return 100;
  const double upper = *(first - 1);
  return 100 * (above - 0.5 + (upper - height) / (upper - *first)) / n;
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
  const Index start = flattest_secant(heights_, width);
  const auto n = static_cast<double>(width + 1);
  const double middle = static_cast<double>(width) / 2;
  const auto sum_of = [&](const auto& term) {
    return deterministic_sum(width + 1, [&](Index begin, Index end) {
      double total = 0;
      for (Index i = begin; i < end; ++i) {
        total +=
            term(static_cast<double>(i) - middle, heights_[static_cast<std::size_t>(start + i)]);
      }
      return total;
    });
  };
  const double mean = sum_of([](double, double z) { return z; }) / n;
  const double slope = sum_of([&](double x, double z) { return x * (z - mean); }) /
                       sum_of([](double x, double) { return x * x; });
  // The heights lie at the middles of their shares: 0 % is half a place before the first.
  const double centre = static_cast<double>(start) + middle + 0.5;
  const double upper = mean - slope * centre;
  return {upper, upper + slope * static_cast<double>(size())};
}

}  // namespace tabor::metrology
