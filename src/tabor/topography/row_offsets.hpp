#pragma once

#include <vector>

#include "tabor/topography/topography.hpp"

// Finds and removes offsets between neighbouring rows of a scan.
namespace tabor::topography {

/// Offsets between neighbouring rows: the medians of their differences.
struct RowJumps {
  std::vector<double> jumps;  ///< of each row against the one before, 0 for the first [m]
  double size = 0;            ///< rms of the jumps about their median, over sqrt 2 [m]
  double chance =
      0;  ///< of the size over within_rows that medians of so few heights have by chance
  double within_rows = 0;  ///< typical rms of the differences about their median, over sqrt 2 [m]
  /// Correlation of one jump with the next: -1/2 for independent offsets of rows, more for slopes
  /// and grooves.
  double correlation = 0;

  /// True where the offsets are not negligible against the roughness.
  bool are_large() const;
  /// True where the jumps alternate as offsets of scan lines do; grooves along x jump as far, but
  /// smoothly.
  bool are_offsets() const;
};

/// Finds the jumps from about `sample` heights of each row. Pairs of rows without common heights do
/// not jump.
RowJumps row_jumps(const Field& height, Index sample);

/// Removes the offsets between rows: the medians of the differences between neighbouring rows,
/// summed from row to row; the mean stays. Does not change a surface whose rows do not jump: there
/// the medians are random, and their sum would be a random walk.
Topography level_rows(Topography topography);

}  // namespace tabor::topography
