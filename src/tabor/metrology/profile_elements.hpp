#pragma once

#include <Eigen/Core>
#include <vector>

#include "tabor/core/types.hpp"

namespace tabor::metrology {

/// A hill of a profile followed by a dale, or a dale followed by a hill, from one crossing of the
/// mean line to the second next.
struct ProfileElement {
  double spacing = 0;  ///< [points]
  double height = 0;   ///< highest minus lowest point [m]
};

/// What is too small to be a hill or dale of its own: it belongs to the one before it.
struct Discrimination {
  double hill = 0;     ///< least height above the mean line [m]
  double dale = 0;     ///< least depth below it [m]
  double spacing = 0;  ///< least length between its crossings [points]
};

/// The elements of the profile z [m] about its mean line z = 0, read from the left; crossings are
/// interpolated, and where something too small lies between two portions the last one counts.
/// Elements lie within stretches without holes; a portion cut off at the end of a stretch ends no
/// element.
std::vector<ProfileElement> profile_elements(const Eigen::ArrayXd& z,
                                             const Discrimination& discrimination);

}  // namespace tabor::metrology
