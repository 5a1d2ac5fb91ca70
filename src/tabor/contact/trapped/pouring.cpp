#include "tabor/contact/trapped/pouring.hpp"

#include <algorithm>
#include <cmath>

namespace tabor::contact {
namespace {

constexpr int kMostSteps = 200;
constexpr Index kPocketsPerBlock = 64;

/// Sums in one thread: pockets are shared among threads.
struct SerialSum {
  template <typename Term>
  double operator()(std::size_t n, const Term& term) const {
    double total = 0;
    for (std::size_t i = 0; i < n; ++i) total += term(i);
    return total;
  }
};

/// Sums on all threads, of a pocket that is large.
struct SharedSum {
  template <typename Term>
  double operator()(std::size_t n, const Term& term) const {
    return sum_over(n, term);
  }
};

}  // namespace

Pouring::Pouring(const Pockets& pockets, double bulk_modulus, double cap)
    : pockets_(pockets), bulk_modulus_(bulk_modulus), cap_(cap), by_pocket_(pockets.size()) {
  for (std::size_t k = 0; k < pockets.size(); ++k) {
    const bool is_large = static_cast<Index>(pockets.n_pixels(k)) > 2 * kBlock;
    (is_large ? large_ : small_).push_back(static_cast<std::uint32_t>(k));
  }
}

/// The level m >= 0 with sum max(m - q - shift, 0) = t V (1 - m/K), at most `most`. Newton on a
/// convex function: after its first step it falls to the level from above and ends there.
template <typename Sum>
Pouring::Poured Pouring::pour(std::size_t pocket, double step, double most, double shift,
                              double guess, const double* q, const Sum& sum) const {
  const std::size_t n = pockets_.n_pixels(pocket);
  const double volume = step * pockets_.volume[pocket];
  const double softness = std::isfinite(bulk_modulus_) ? volume / bulk_modulus_ : 0;
  double level = guess;
  double wet = 0;
  for (int i = 0; i < kMostSteps; ++i) {
    const double depth = sum(n, [=](std::size_t j) { return std::max(level - q[j] - shift, 0.0); });
    wet = sum(n, [=](std::size_t j) { return level > q[j] + shift ? 1.0 : 0.0; });
    const double excess = depth - volume + softness * level;
    const double slope = wet + softness;
    if (slope == 0 || (i > 0 && excess <= 1e-15 * volume)) {
      if (slope > 0) break;
      level = *std::min_element(q, q + n) + shift + volume;  // one pixel alone holds it
      continue;
    }
    const double next = level - excess / slope;
    if (next == level || (i > 0 && next > level)) break;
    level = next;
  }
  const double bounded = std::clamp(level, 0.0, std::min(most, cap_));
  return {bounded, bounded == level ? wet / (wet + softness) : 0};
}

Pouring::Carried Pouring::carried_by(std::size_t pocket, const Poured& poured, double shift,
                                     const double* q) const {
  Carried sums;
  for (std::size_t j = 0; j < pockets_.n_pixels(pocket); ++j) {
    const double p = q[j] + shift;
    if (p <= poured.level) {
      sums.load += poured.level;
      sums.slope += poured.level_slope;
    } else if (p < cap_) {
      sums.load += p;
      sums.slope += 1;
    } else {
      sums.load += cap_;
    }
  }
  return sums;
}

/// Pours into every pocket and returns what all pixels carry.
Pouring::Carried Pouring::carried(const std::vector<double>& steps, const std::vector<double>& most,
                                  double shift, const Wanted& wanted, std::vector<double>& level) {
  const auto fill = [&](std::uint32_t k, const auto& sum) {
    const double* q = wanted.inside.data() + pockets_.first[k];
    const double weight = steps[k] / wanted.step;
    const Poured poured = pour(k, steps[k], most[k], weight * shift, level[k], q, sum);
    level[k] = poured.level;
    by_pocket_[k] = carried_by(k, poured, weight * shift, q);
    by_pocket_[k].slope *= weight;
  };
  for (const std::uint32_t k : large_) fill(k, SharedSum{});
  for_each(
      small_.size(), [&](std::size_t i) { fill(small_[i], SerialSum{}); }, kPocketsPerBlock);
  const auto inside = [&, shift](double q) { return q + shift > 0 && q + shift < cap_; };
  Carried sums;
  sums.load = sum_over(wanted.outside.size(), [&](std::size_t i) {
    return std::clamp(wanted.outside[i] + shift, 0.0, cap_);
  });
  sums.slope = static_cast<double>(
      count_where(wanted.outside.size(), [&](std::size_t i) { return inside(wanted.outside[i]); }));
  for (const Carried& one : by_pocket_) {
    sums.load += one.load;
    sums.slope += one.slope;
  }
  return sums;
}

/// Safeguarded Newton on an increasing function; ends at rounding.
double Pouring::find_shift(const std::vector<double>& steps, const std::vector<double>& most,
                           double load, const Wanted& wanted, std::vector<double>& level) {
  const Extent outside = extent_over(std::ssize(wanted.outside), wanted.outside.data());
  const Extent inside = extent_over(std::ssize(wanted.inside), wanted.inside.data());
  double least = 1;
  for (const double step : steps) least = std::min(least, step / wanted.step);
  // All pressures are zero at `low`, unless liquid stands there; at `high` each carries the load.
  double low = -(std::max({outside.highest, inside.highest, 0.0}) + load) / least;
  double high = (std::min(load, cap_) - std::min({outside.lowest, inside.lowest, 0.0})) / least;
  double shift = std::clamp(0.0, low, high);
  for (int i = 0; i < kMostSteps; ++i) {
    const Carried sums = carried(steps, most, shift, wanted, level);
    const double excess = sums.load - load;
    if (std::abs(excess) <= 1e-15 * load) break;
    (excess > 0 ? high : low) = shift;
    const double newton = sums.slope > 0 ? shift - excess / sums.slope : high;
    const double next = newton > low && newton < high ? newton : 0.5 * (low + high);
    if (next == shift || next == low || next == high) break;
    shift = next;
  }
  return shift;
}

std::optional<double> Pouring::project(const std::vector<double>& steps,
                                       const std::vector<double>& most, double load, Wanted& wanted,
                                       std::vector<double>& level) {
  const double shift = find_shift(steps, most, load, wanted, level);
  const double found = carried(steps, most, shift, wanted, level).load;
  for_each(wanted.outside.size(), [&](std::size_t i) {
    wanted.outside[i] = std::clamp(wanted.outside[i] + shift, 0.0, cap_);
  });
  for_each(pockets_.size(), [&](std::size_t k) {
    for (std::size_t j = pockets_.first[k]; j < pockets_.first[k + 1]; ++j) {
      const double p = wanted.inside[j] + steps[k] / wanted.step * shift;
      wanted.inside[j] = std::clamp(p, level[k], cap_);
    }
  });
  if (std::abs(found - load) > 1e-9 * load) return std::nullopt;
  return shift;
}

}  // namespace tabor::contact
