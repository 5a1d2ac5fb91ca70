#include "tabor/contact/certificate.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "tabor/core/loops.hpp"

namespace tabor::contact {
namespace {

/// The pressures that make <s, v> smallest.
struct Knapsack {
  double threshold;  // smallest residual of the pixels that are not full
  double smallest;   // <s, v - threshold> [Pa m]
};

/// Puts p_sat on the smallest residuals until the load is carried; without a cap one pixel takes
/// all.
Knapsack fill_alike(const std::vector<double>& v, double load, double cap) {
  const auto n_full = std::isfinite(cap)
                          ? std::min(static_cast<std::size_t>(std::floor(load / cap)), v.size() - 1)
                          : 0;
  if (n_full == 0) return {*std::min_element(v.begin(), v.end()), 0};
  std::vector<double> sorted_start = v;
  const auto place = sorted_start.begin() + static_cast<std::ptrdiff_t>(n_full);
  std::nth_element(sorted_start.begin(), place, sorted_start.end());
  const double threshold = *place;
  const double smallest =
      sum_over(n_full, [&](std::size_t i) { return sorted_start[i] - threshold; });
  return {threshold, cap * smallest};
}

/// The same where each pixel has its own cap.
Knapsack fill_each(const std::vector<double>& v, double load, const Caps& caps) {
  std::vector<std::size_t> order(v.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return v[a] < v[b]; });
  std::size_t n_full = 0;
  double carried = caps(order[0]);
  while (carried <= load && n_full + 1 < v.size()) carried += caps(order[++n_full]);
  const double threshold = v[order[n_full]];
  const double smallest =
      sum_over(n_full, [&](std::size_t k) { return caps(order[k]) * (v[order[k]] - threshold); });
  return {threshold, smallest};
}

Knapsack fill(const std::vector<double>& v, double load, const Caps& caps) {
  return caps.are_one() ? fill_alike(v, load, caps.for_all()) : fill_each(v, load, caps);
}

}  // namespace

double knapsack_threshold(const std::vector<double>& v, double load, const Caps& caps) {
  return fill(v, load, caps).threshold;
}

double duality_gap(const Candidates& candidates, double load, const Caps& caps) {
  const std::vector<double>& v = candidates.residual;
  if (v.empty()) return 0;
  const Knapsack knapsack = fill(v, load, caps);
  // Measured from the threshold, both products are small where the pressure is nearly optimal.
  const double product = sum_over(v.size(), [&](std::size_t i) {
    return candidates.pressure[i] * (v[i] - knapsack.threshold);
  });
  return product - knapsack.smallest;
}

}  // namespace tabor::contact
