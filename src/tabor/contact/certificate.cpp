#include "tabor/contact/certificate.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tabor/core/loops.hpp"

namespace tabor::contact {
namespace {

struct Knapsack {
  std::vector<double> full;  // residuals of the pixels that take the whole saturation pressure
  double threshold;          // smallest residual of the others
};

/// Puts p_sat on the smallest residuals until the load is carried; without a cap one pixel takes
/// all.
Knapsack fill_knapsack(const Candidates& candidates, double load, double saturation_pressure) {
  const std::vector<double>& residual = candidates.residual;
  const auto n_full =
      std::isfinite(saturation_pressure)
          ? std::min(static_cast<std::size_t>(std::floor(load / saturation_pressure)),
                     residual.size() - 1)
          : 0;
  if (n_full == 0) return {{}, *std::min_element(residual.begin(), residual.end())};
  std::vector<double> sorted_start = residual;
  const auto threshold = sorted_start.begin() + static_cast<std::ptrdiff_t>(n_full);
  std::nth_element(sorted_start.begin(), threshold, sorted_start.end());
  const double value = *threshold;
  sorted_start.resize(n_full);
  return {std::move(sorted_start), value};
}

}  // namespace

double duality_gap(const Candidates& candidates, double load, double saturation_pressure) {
  if (candidates.residual.empty()) return 0;
  const Knapsack knapsack = fill_knapsack(candidates, load, saturation_pressure);
  // Measured from the threshold, both products are small where the pressure is nearly optimal.
  const double threshold = knapsack.threshold;
  const double product = sum_over(candidates.pressure.size(), [&](std::size_t i) {
    return candidates.pressure[i] * (candidates.residual[i] - threshold);
  });
  const double smallest =
      sum_over(knapsack.full.size(), [&](std::size_t i) { return knapsack.full[i] - threshold; });
  return knapsack.full.empty() ? product : product - saturation_pressure * smallest;
}

}  // namespace tabor::contact
