#pragma once

#include <functional>
#include <string>
#include <vector>

#include "rows.hpp"
#include "subject.hpp"

namespace tabor::scan::test {

/// What a row of expected.csv asks of us: a number of ours, and how near it must be.
struct Claim {
  std::function<bool(const Row&)> applies;
  std::function<double(Subject&)> ours;
  /// Relative; 0: half a unit of the last printed digit, at least 1e-9 (moments).
  double tolerance = 0;
  double absolute_tolerance = 0;  ///< in the row's unit, where that is what is asked
  /// The published number cannot be had from the file; the list's own is compared.
  bool against_recomputed = false;
  /// For a number that is known to be wrong: ours above is what reproduces it, and this is our
  /// value, which must be another one.
  std::function<double(Subject&)> true_value = {};
};

/// All claims. Every row belongs to exactly one, or to `unclaimed_reason`.
const std::vector<Claim>& claims();

/// Why a row is left out; "" if it is not.
std::string unclaimed_reason(const Row& row);

}  // namespace tabor::scan::test
