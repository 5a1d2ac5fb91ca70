#include "tabor/metrology/areal/parameter_means.hpp"

#include <algorithm>
#include <cmath>

namespace tabor::metrology {
namespace {

/// The values of one parameter, by its symbol.
struct Gathered {
  std::string symbol;
  std::string unit;
  std::vector<double> values;
};

std::vector<double>& values_of(const Parameter& parameter, std::vector<Gathered>& all) {
  const auto known = std::find_if(
      all.begin(), all.end(), [&](const Gathered& one) { return one.symbol == parameter.symbol; });
  if (known != all.end()) return known->values;
  return all.emplace_back(Gathered{parameter.symbol, parameter.unit, {}}).values;
}

}  // namespace

std::vector<ParameterMean> parameter_means(const std::vector<std::vector<Parameter>>& surfaces) {
  std::vector<Gathered> all;
  for (const std::vector<Parameter>& parameters : surfaces) {
    for (const Parameter& parameter : parameters) {
      std::vector<double>& values = values_of(parameter, all);
      if (std::isfinite(parameter.value)) values.push_back(parameter.value);
    }
  }
  std::vector<ParameterMean> means;
  means.reserve(all.size());
  for (const Gathered& one : all) means.push_back({one.symbol, one.unit, mean_of(one.values)});
  return means;
}

}  // namespace tabor::metrology
