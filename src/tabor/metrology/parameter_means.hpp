#pragma once

#include <string>
#include <vector>

#include "tabor/core/mean.hpp"
#include "tabor/metrology/parameter.hpp"

namespace tabor::metrology {

/// One parameter of several surfaces. Surfaces without a value do not count: value.n says how many
/// did.
struct ParameterMean {
  std::string symbol;  ///< "Sq"
  std::string unit;    ///< of mean and deviation, SI
  Mean value;
};

/// Of all parameters, in the order in which they first appear.
std::vector<ParameterMean> parameter_means(const std::vector<std::vector<Parameter>>& surfaces);

}  // namespace tabor::metrology
