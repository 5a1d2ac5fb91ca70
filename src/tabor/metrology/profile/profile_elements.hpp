#pragma once

#include <Eigen/Core>
#include <vector>

#include "tabor/core/types.hpp"

// Divides a profile into its elements, a hill and a dale each.
namespace tabor::metrology {

/// Hill of a profile followed by a dale, or dale followed by a hill, from one crossing of the mean
/// line to the second next.
struct ProfileElement {
  double spacing = 0;  ///< [points]
  double height = 0;   ///< highest minus lowest point [m]
};

/// Limits below which a portion is no hill or dale of its own, but belongs to the one before it.
struct Discrimination {
  double hill = 0;     ///< least height above the mean line [m]
  double dale = 0;     ///< least depth below it [m]
  double spacing = 0;  ///< least length between its crossings [points]
};

/// Finds the elements of the profile z [m] about its mean line z = 0, from the left; crossings are
/// interpolated, and where something too small lies between two portions the last one counts.
/// Elements lie within stretches without holes; a portion cut off at the end of a stretch ends no
/// element.
std::vector<ProfileElement> profile_elements(const Eigen::ArrayXd& z,
                                             const Discrimination& discrimination);

}  // namespace tabor::metrology
