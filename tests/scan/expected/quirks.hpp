#pragma once

#include "tabor/topography/topography.hpp"

namespace tabor::scan::test {

/// Another program's rms height of a surface with holes: sums over the valid points divided by the
/// number of ALL points. Shown here only to prove that the surfaces are the same.
double rms_height_over_all_points(const topography::Topography& topography);
/// The same of rows about their own mean.
double rms_row_height_over_all_points(const topography::Topography& topography);
/// Gradient whose squared differences are divided by nx ny instead of by their number.
double rms_slope_over_all_points(const topography::Topography& topography);

}  // namespace tabor::scan::test
