#pragma once

#include <utility>
#include <vector>

#include "tabor/core/convergence.hpp"
#include "tabor/core/types.hpp"

// Computes the material ratio (Abbott-Firestone) curve and its core, from which Sk, Smr, Vm and Vv
// follow.
namespace tabor::metrology {

/// Straight line fitted to a part of the curve: height [m] at 0 % and at 100 %.
struct CoreLine {
  double upper = 0;
  double lower = 0;
};

/// Core of the curve and the parts beyond it.
struct Core {
  CoreLine line;
  double height = 0;       ///< Sk [m]
  double peak_height = 0;  ///< Spk [m]
  double dale_height = 0;  ///< Svk [m]
  double peak_ratio = 0;   ///< Smrk1 [%], the share above the line at 0 %
  double dale_ratio = 0;   ///< Smrk2 [%], all but the share below the line at 100 %
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

  /// Returns Smc(p) [m]: the height above which p per cent of the area lie.
  double height_at(double percent) const;
  /// Returns Smr(c) [%]: the share of the area above c. A plateau at c counts half. Heights that
  /// differ from c by rounding alone are at c, here and in core().
  double ratio_above(double height) const;
  /// Returns the material above the height c [m^3/m^2]: <max(z - c, 0)>.
  double material_above(double height) const;
  /// Returns the void below the height c [m^3/m^2]: <max(c - z, 0)>.
  double void_below(double height) const;

  /// Returns the least-squares line over the 40 % of the curve whose secant falls least (the first
  /// of equal ones). NaN with fewer than two heights. ISO 25178-2, as ISO 13565-2 for profiles.
  CoreLine core_line() const;
  /// Returns the core. A plateau at an end of the line is part of the core: neither hill nor dale.
  Core core() const;

 private:
  using Place = std::vector<double>::const_iterator;
  /// Returns the range of heights that are equal to this one but for rounding.
  std::pair<Place, Place> equal_to(double height) const;
  double ratio_between(Place first, double height) const;
  Index flattest_secant(Index width) const;

  std::vector<double> heights_;  ///< [m] about the mean, falling
  double rounding_ = 0;          ///< [m] of the heights as they came
};

/// Returns the valid heights minus `mean`, falling. The result is the same for any number of
/// threads.
std::vector<double> falling_heights(const Field& height, Index n_valid, double mean,
                                    const Observer& observer = {});

}  // namespace tabor::metrology
