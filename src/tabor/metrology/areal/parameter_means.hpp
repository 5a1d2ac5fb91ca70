#pragma once

#include <string>
#include <vector>

#include "tabor/core/mean.hpp"
#include "tabor/metrology/areal/parameter.hpp"

// Averages roughness parameters over several surfaces.
namespace tabor::metrology {

/// Mean of one parameter over several surfaces. Surfaces without a value do not count: value.n is
/// the number of those that do.
struct ParameterMean {
  std::string symbol;  ///< "Sq"
  std::string unit;    ///< of mean and deviation, SI
  Mean value;
};

/// Averages all parameters, in the order in which they first appear.
std::vector<ParameterMean> parameter_means(const std::vector<std::vector<Parameter>>& surfaces);

}  // namespace tabor::metrology
