#pragma once

#include <vector>

#include "tabor/core/convergence.hpp"
#include "tabor/core/types.hpp"

namespace tabor::metrology {

/// Straight line over a stretch of the curve: height at 0 % and at 100 %. [m]
struct CoreLine {
  double upper = 0;
  double lower = 0;
};

/// Material ratio (Abbott-Firestone) curve of the valid heights about their mean, without classes:
/// the sorted heights themselves. The k-th highest of N stands for the ratios k/N to (k+1)/N, at
/// whose middle it lies; straight lines between. 8 bytes per pixel.
class AbbottCurve {
 public:
  /// Throws InputError if every pixel is a hole, Interrupted when the observer stops it.
  explicit AbbottCurve(const Field& height, const Observer& observer = {});

  Index size() const { return static_cast<Index>(heights_.size()); }
  double highest() const { return heights_.front(); }  ///< [m] about the mean
  double lowest() const { return heights_.back(); }    ///< [m] about the mean

  /// Smc(p): the height above which p per cent of the area lie. [m]
  double height_at(double percent) const;
  /// Smr(c): share of the area above c. [%] A plateau at c counts half.
  double ratio_above(double height) const;
  /// <max(z - c, 0)>: material above the height c. [m^3/m^2]
  double material_above(double height) const;
  /// <max(c - z, 0)>: void below the height c. [m^3/m^2]
  double void_below(double height) const;

  /// Least-squares line over the 40 % of the curve whose secant falls least (the first of equal
  /// ones). NaN with fewer than two heights. ISO 25178-2, as ISO 13565-2 for profiles.
  CoreLine core_line() const;

 private:
  std::vector<double> heights_;  ///< [m] about the mean, falling
};

/// Valid heights minus `mean`, falling. Same result for any number of threads.
std::vector<double> falling_heights(const Field& height, Index n_valid, double mean,
                                    const Observer& observer = {});

}  // namespace tabor::metrology
