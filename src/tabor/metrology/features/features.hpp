#pragma once

#include <vector>

#include "tabor/core/convergence.hpp"
#include "tabor/metrology/areal/parameter.hpp"
#include "tabor/topography/topography.hpp"

// Computes the feature parameters of ISO 25178-2 (Spd, S5p, Sha, ...) from hills and dales.
namespace tabor::metrology {

/// Settings that decide what counts as a feature.
struct FeatureOptions {
  double pruning = 0.05;  ///< Wolf pruning: least height difference as a share of Sz, 0 to 1
};

/// Computes the feature parameters (ISO 25178-2:2021) and Sds (EUR 15178) of the surface as given:
/// Spd Svd Spc Svc S5p S5v S10z Sda Sha Sdv Shv Sds. Heights count from the mean of the valid
/// points. A peak or pit counts if its eight neighbours are valid points of the map; a hill or dale
/// counts for Sda, Sha, Sdv, Shv if it is closed: no pixel on the edge or beside a hole. A
/// parameter that does not exist is NaN with a note. Throws InputError if all points are holes or
/// `pruning` is not in [0, 1]; Interrupted when the observer stops it.
std::vector<Parameter> feature_parameters(const topography::Topography& topography,
                                          const FeatureOptions& options = {},
                                          const Observer& observer = {});

}  // namespace tabor::metrology
