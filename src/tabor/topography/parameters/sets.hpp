#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "tabor/topography/parameters.hpp"
#include "tabor/topography/rows.hpp"

namespace tabor::topography {

class AbbottCurve;

inline constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();

/// One function per set; parameters() calls the chosen ones. Every symbol appears in one set only.
std::vector<Parameter> height_parameters(const Topography& topography);
std::vector<Parameter> hybrid_parameters(const Topography& topography,
                                         const ParameterOptions& options);
std::vector<Parameter> function_parameters(const AbbottCurve& curve,
                                           const ParameterOptions& options);
std::vector<Parameter> volume_parameters(const AbbottCurve& curve, const ParameterOptions& options);
std::vector<Parameter> spatial_parameters(const Topography& topography,
                                          const ParameterOptions& options,
                                          const Observer& observer);
std::vector<Parameter> spectral_parameters(const Topography& topography);

/// Mean over the (nx-1)(ny-1) cells of of_cell(y, x), cells where it is NaN left out; NaN without
/// cells.
template <typename OfCell>
double mean_over_cells(const Grid& grid, const OfCell& of_cell) {
  const auto sums = sum_over_rows<2>(std::max<Index>(0, grid.ny - 1), [&](Index y) {
    Eigen::Array2d row = Eigen::Array2d::Zero();
    for (Index x = 0; x + 1 < grid.nx; ++x) {
      const double value = of_cell(y, x);
      if (!std::isnan(value)) {
        row += Eigen::Array2d(value, 1);
      }
    }
    return row;
  });
  return sums[1] > 0 ? sums[0] / sums[1] : kNoValue;
}

}  // namespace tabor::topography
