#pragma once

#include "tabor/core/convergence.hpp"
#include "tabor/topography/topography.hpp"

// Finds the shift between two scans of the same place, to a small part of a pixel.
namespace tabor::comparison {

/// Plane between two scans, over pixels, c0 + c1 u + c2 v with u, v from -1 to 1 across the map.
struct RobustPlane {
  double offset = 0;  ///< [m]
  double tilt_x = 0;  ///< [m] over half the width
  double tilt_y = 0;  ///< [m] over half the height
  double spread = 0;  ///< [m], robust standard deviation about the plane
};

/// Position of scan B relative to scan A: what is at (x, y) in A, from its top left corner, is at
/// (x + shift_x, y + shift_y) in B. Rotation and stretch are not searched.
struct Registration {
  double shift_x = 0;        ///< [m]
  double shift_y = 0;        ///< [m]
  double uncertainty_x = 0;  ///< [m], one standard deviation, from the scatter between 64 blocks
  double uncertainty_y = 0;  ///< [m]
  double correlation = 0;    ///< of both heights over the overlap, planes removed
  double overlap = 0;        ///< valid common points over those of the smaller scan
  double distinction = 0;    ///< correlation of the coarse search over its scatter at all shifts
  double runner_up = 0;      ///< next best coarse correlation at another shift, over the best
  int iterations = 0;        ///< of the refinement, over all sizes
};

/// Limits below which a match is not credible.
struct RegistrationOptions {
  double smallest_overlap = 0.25;     ///< of the smaller scan, for a shift to be considered
  double smallest_distinction = 6;    ///< below, the match is not credible
  double smallest_correlation = 0.3;  ///< of the heights in the end
};

/// Finds the shift to a small part of a pixel. Coarse: the correlation coefficient over valid
/// common points at all shifts (Padfield 2012, IEEE Trans. Image Process. 21:2706,
/// doi:10.1109/TIP.2011.2181402) of both maps on common coarse pixels without waves longer than an
/// eighth of the smaller side. Fine: least squares of the height difference in shift, offset and
/// tilt, from coarse to full size, robust against places that changed (Tukey's biweight).
///
/// Throws InputError when the scans do not match credibly: no shift stands out, or the heights
/// there correlate too little.
Registration register_scans(const topography::Topography& a, const topography::Topography& b,
                            const RegistrationOptions& options = {}, const Observer& observer = {});

/// Returns B's heights at A's pixels under a shift [m]: shape of A, NaN where B has none. Where B's
/// pixels are smaller by half or more, its heights are averaged over A's pixels first.
Field move_onto(const topography::Topography& b, const Grid& a, double shift_x, double shift_y);

}  // namespace tabor::comparison
