#include "tabor/contact/certificate.hpp"

#include <algorithm>
#include <cmath>

#include "tabor/core/parallel.hpp"

namespace tabor::contact {
namespace {

struct Knapsack {
  std::vector<double> sorted_start;  // residuals, the n_full smallest first, then the threshold
  std::size_t n_full = 0;            // pixels that take the whole saturation pressure
  double remainder = 0;              // pressure on the threshold pixel [Pa]
};

/// Puts p_sat on the smallest residuals until the load is carried; without a cap one pixel takes
/// all.
Knapsack fill_knapsack(const Candidates& candidates, double load, double saturation_pressure) {
  Knapsack knapsack{candidates.residual, 0, load};
  if (std::isfinite(saturation_pressure)) {
    const auto n_full = static_cast<std::size_t>(std::floor(load / saturation_pressure));
    knapsack.n_full = std::min(n_full, knapsack.sorted_start.size() - 1);
    knapsack.remainder = load - static_cast<double>(knapsack.n_full) * saturation_pressure;
  }
  const auto threshold =
      knapsack.sorted_start.begin() + static_cast<std::ptrdiff_t>(knapsack.n_full);
  std::nth_element(knapsack.sorted_start.begin(), threshold, knapsack.sorted_start.end());
  return knapsack;
}

}  // namespace

double duality_gap(const Candidates& candidates, double load, double saturation_pressure) {
  if (candidates.residual.empty()) {
    return 0;
  }
  const Knapsack knapsack = fill_knapsack(candidates, load, saturation_pressure);
  // Measured from the threshold, both products are small where the pressure is nearly optimal.
  const double threshold = knapsack.sorted_start[knapsack.n_full];
  const double product = deterministic_sum(
      static_cast<Index>(candidates.pressure.size()), [&](Index begin, Index end) {
        double partial = 0;
        for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
          partial += candidates.pressure[i] * (candidates.residual[i] - threshold);
        }
        return partial;
      });
  if (knapsack.n_full == 0) {
    return product;
  }
  const double smallest =
      deterministic_sum(static_cast<Index>(knapsack.n_full), [&](Index begin, Index end) {
        double partial = 0;
        for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
          partial += knapsack.sorted_start[i] - threshold;
        }
        return partial;
      });
  return product - saturation_pressure * smallest;
}

}  // namespace tabor::contact
