#pragma once

#include <vector>

#include "tabor/core/convergence.hpp"
#include "tabor/metrology/areal/parameter.hpp"
#include "tabor/metrology/profile/profile.hpp"
#include "tabor/topography/topography.hpp"

// Computes the areal roughness parameters of ISO 25178-2 and their companions for a surface.
namespace tabor::metrology {

/// Differences that Sdq uses.
/// forward: on the (nx-1)(ny-1) pixels that have a right and a lower neighbour.
/// seven_point: (z3 - 9 z2 + 45 z1 - 45 z-1 + 9 z-2 - z-3) / (60 dx), pixels with three neighbours
/// on all four sides.
enum class SlopeStencil { forward, seven_point };

/// Division of the cell between four pixels for Sdr: the mean of both splits into two triangles, or
/// four triangles to the mean of the corners.
enum class AreaTriangles { two, four };

/// Settings of parameters().
struct ParameterOptions {
  std::vector<ParameterSet> sets{kParameterSets.begin(), kParameterSets.end()};
  SlopeStencil stencil = SlopeStencil::forward;
  AreaTriangles triangles = AreaTriangles::two;
  double smr_height = 0;       ///< c of Smr(c) [m], about the mean of the valid points
  double peak_ratio = 10;      ///< p [%] of Smc(p), Sdc, Vm(p), Vv(p), Vmp, Vmc, Vvc
  double valley_ratio = 80;    ///< q [%] of Smc(q), Sdc, Vmc, Vvc, Vvv
  double acf_threshold = 0.2;  ///< s of Sal and Str
  double pruning = 0.05;       ///< Wolf pruning of the feature parameters, share of Sz
  ProfileOptions profile = {};
};

/// Computes the parameters of the chosen sets, of the surface AS GIVEN: heights about the mean of
/// its valid points. ISO defines them for a levelled surface; level first (`--level plane`). The
/// height set begins with N, the number of valid points. A parameter that cannot be computed (one
/// row, one pixel, flat, holes everywhere between) has the value NaN and a note. Throws InputError
/// if all are holes or an option is invalid; Interrupted when the observer stops it.
std::vector<Parameter> parameters(const topography::Topography& topography,
                                  const ParameterOptions& options = {},
                                  const Observer& observer = {});

/// Computes Sdq: root mean square of the gradient over the pixels whose stencil touches no hole;
/// the pixels beyond the edge are never taken from the other side, periodic or not. NaN without
/// such pixels. [1]
double rms_slope(const topography::Topography& topography,
                 SlopeStencil stencil = SlopeStencil::forward);

/// Computes Sdr [%]: developed over projected area minus one, over cells without holes.
double developed_area_ratio(const topography::Topography& topography,
                            AreaTriangles triangles = AreaTriangles::two);

/// Computes Sq [m]: root mean square height about the mean of the valid points.
double rms_height(const topography::Topography& topography);

}  // namespace tabor::metrology
