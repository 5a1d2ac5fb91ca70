#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "tabor/core/rows.hpp"
#include "tabor/metrology/areal/parameters.hpp"

// Declares the functions that compute the areal roughness parameters, one per set of ISO 25178-2.
namespace tabor::metrology {

class AbbottCurve;

inline constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();

/// Compute one set of parameters each; parameters() calls the chosen ones. Every symbol appears in
/// one set only.
std::vector<Parameter> height_parameters(const topography::Topography& topography);
std::vector<Parameter> hybrid_parameters(const topography::Topography& topography,
                                         const ParameterOptions& options);
std::vector<Parameter> function_parameters(const AbbottCurve& curve,
                                           const ParameterOptions& options);
std::vector<Parameter> volume_parameters(const AbbottCurve& curve, const ParameterOptions& options);
std::vector<Parameter> spatial_parameters(const topography::Topography& topography,
                                          const ParameterOptions& options,
                                          const Observer& observer);
std::vector<Parameter> spectral_parameters(const topography::Topography& topography);

}  // namespace tabor::metrology
