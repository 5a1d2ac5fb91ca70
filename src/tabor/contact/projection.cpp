#include "tabor/contact/projection.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tabor/core/loops.hpp"

namespace tabor::contact {
namespace {

/// Value of sum clip(x - shift, 0, caps) and number of terms strictly inside the bounds.
std::pair<double, double> load_and_slope(const std::vector<double>& x, double shift,
                                         const Caps& caps) {
  if (!caps.are_one()) {
    const double load =
        sum_over(x.size(), [&](std::size_t i) { return std::clamp(x[i] - shift, 0.0, caps(i)); });
    const auto is_inside = [&](std::size_t i) { return x[i] > shift && x[i] - shift < caps(i); };
    return {load, static_cast<double>(count_where(x.size(), is_inside))};
  }
  const double cap = caps.for_all();
  const auto clipped_sum = [=](const auto& block) {
    return (block - shift).max(0.0).min(cap).sum();
  };
  const double load = sum_over_blocks(std::ssize(x), clipped_sum, x.data());
  const auto is_inside = [=, values = x.data()](std::size_t i) {
    return static_cast<Index>(values[i] > shift) & static_cast<Index>(values[i] - shift < cap);
  };
  return {load, static_cast<double>(count_where(x.size(), is_inside))};
}

}  // namespace

double shift_for_load(const std::vector<double>& x, double load, const Caps& caps) {
  const Extent extent = extent_over(std::ssize(x), x.data());
  // At `low` the sum is at least the load, at `high` it is zero.
  double low = extent.lowest - std::min(caps.highest(std::ssize(x)), load);
  double high = extent.highest;
  double shift = std::clamp(0.0, low, high);
  constexpr int most_steps = 200;
  for (int step = 0; step < most_steps; ++step) {
    const auto [sum, n_inside] = load_and_slope(x, shift, caps);
    const double excess = sum - load;
    if (std::abs(excess) <= 1e-15 * load) break;
    (excess > 0 ? low : high) = shift;
    const double newton = n_inside > 0 ? shift + excess / n_inside : low;
    const double next = (newton > low && newton < high) ? newton : 0.5 * (low + high);
    if (next == shift || next == low || next == high) {
      break;  // the bracket is two neighbouring numbers: rounding error is reached
    }
    shift = next;
  }
  return shift;
}

void project_on_load(std::vector<double>& x, double load, const Caps& caps) {
  double shift = shift_for_load(x, load, caps);
  // A shift far larger than the pressures loses load to rounding; what it leaves near the bounds is
  // exact and is shifted again.
  constexpr double lost = 1e-12;
  constexpr int most_rounds = 4;
  for (int round = 0;
       round < most_rounds && std::abs(load_and_slope(x, shift, caps).first - load) > lost * load;
       ++round) {
    for_each(x.size(), [&](std::size_t i) { x[i] -= shift; });
    shift = shift_for_load(x, load, caps);
  }
  for_each(x.size(), [&](std::size_t i) { x[i] = std::clamp(x[i] - shift, 0.0, caps(i)); });
}

}  // namespace tabor::contact
