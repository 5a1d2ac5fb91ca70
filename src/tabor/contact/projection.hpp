#pragma once

#include <vector>

#include "tabor/contact/caps.hpp"

// Projects pressures on those that carry a given load within their bounds.
namespace tabor::contact {

/// Returns the shift s for which sum_i clip(x_i - s, 0, cap_i) = load. Safeguarded Newton on a
/// decreasing, piecewise linear function: ends at rounding error. Requires 0 < load < sum of caps.
double shift_for_load(const std::vector<double>& x, double load, const Caps& caps);

/// Sets x_i := clip(x_i - s, 0, cap_i) with that shift: the Euclidean projection of x on the
/// pressures that carry the load.
void project_on_load(std::vector<double>& x, double load, const Caps& caps);

}  // namespace tabor::contact
