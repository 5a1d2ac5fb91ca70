#pragma once

#include "tabor/core/types.hpp"

// Finds the shift of one map over another in whole pixels, by correlation at all shifts.
namespace tabor::comparison {

/// Best shift of one map over another, in whole pixels.
struct CoarseMatch {
  Index shift_x = 0;  ///< what is at (x, y) in A is at (x + shift_x, y + shift_y) in B
  Index shift_y = 0;
  double correlation = 0;  ///< coefficient over the valid common pixels
  double distinction = 0;  ///< correlation * sqrt(pixels), over its robust scatter at all shifts
  double runner_up = 0;    ///< the same further than `lobe` pixels away, over the best
  Index n_shifts = 0;      ///< with enough common pixels; 0 = nothing to choose from
};

/// Correlates the valid common pixels at all shifts that leave at least `smallest_overlap` of the
/// map with fewer valid pixels (Padfield 2012, equations 7 to 10).
CoarseMatch match_coarsely(const Field& a, const Field& b, double smallest_overlap, Index lobe);

}  // namespace tabor::comparison
