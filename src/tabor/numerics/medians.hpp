#pragma once

#include <vector>

#include "tabor/core/registers.hpp"

// Finds medians of several lists side by side, by vector instructions.
namespace tabor::numerics {

/// Returns the upper median of each of kLanes lists: of n values in ascending order, the one at
/// n / 2. values[i] holds the values at place i of all lists. No list may have a NaN, and none may
/// be empty. Reorders the values, and returns one of them.
///
/// Selection that forgets: of the first n / 2 + 2 values neither the least nor the greatest can be
/// the median; both go and the next value joins the others, until none is left to join.
/// Takes n^2 / 4 comparisons: for short lists.
const Lanes& upper_medians(std::vector<Lanes>& values);

}  // namespace tabor::numerics
