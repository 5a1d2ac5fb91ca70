#pragma once

#include <vector>

// Projects pressures on those that carry a given load within their bounds.
namespace tabor::contact {

/// Returns the shift s for which sum_i clip(x_i - s, 0, cap) = load. Safeguarded Newton on a
/// decreasing, piecewise linear function: ends at rounding error. Requires 0 < load < n * cap.
double shift_for_load(const std::vector<double>& x, double load, double cap);

/// Sets x_i := clip(x_i - s, 0, cap) with that shift: the Euclidean projection of x on the
/// pressures that carry the load.
void project_on_load(std::vector<double>& x, double load, double cap);

}  // namespace tabor::contact
