#pragma once

#include <gtest/gtest.h>

#include <string>

#include "tabor/metrology/areal/parameters.hpp"

namespace tabor::metrology::test {

/// One parameter of one set.
inline Parameter parameter(const topography::Topography& topography, ParameterSet set,
                           const std::string& symbol, ParameterOptions options = {}) {
  options.sets = {set};
  for (const Parameter& found : parameters(topography, options)) {
    if (found.symbol == symbol) return found;
  }
  ADD_FAILURE() << "no parameter " << symbol;
  return {};
}

inline double value(const topography::Topography& topography, ParameterSet set,
                    const std::string& symbol, const ParameterOptions& options = {}) {
  return parameter(topography, set, symbol, options).value;
}

}  // namespace tabor::metrology::test
