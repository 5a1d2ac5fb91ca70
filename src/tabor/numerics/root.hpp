#pragma once

#include <cmath>

namespace tabor::numerics {

/// Returns the zero of an increasing function of a positive place, between two places with values
/// of opposite signs (that of `low` may be -infinity): false position in which the value of the
/// retained end is halved (Illinois: Dowell & Jarratt 1971, doi:10.1007/BF01934364), bisection
/// where a value is not finite. Place and value have one unit; the search ends when either is
/// within `accuracy`, relative to the upper end.
template <typename Value>
double increasing_root(const Value& value, double low, double high, double accuracy) {
  double at_high = value(high);
  double at_low = value(low);
  while (high - low > accuracy * high) {
    const bool is_finite = std::isfinite(at_low);
    const double middle =
        is_finite ? (low * at_high - high * at_low) / (at_high - at_low) : (low + high) / 2;
    if (!(middle > low && middle < high)) return middle;
    const double at_middle = value(middle);
    if (std::abs(at_middle) <= accuracy * high) return middle;
    if (at_middle < 0) {
      low = middle;
      at_low = at_middle;
      at_high /= 2;
    } else {
      high = middle;
      at_high = at_middle;
      at_low /= 2;
    }
  }
  return high;
}

}  // namespace tabor::numerics
