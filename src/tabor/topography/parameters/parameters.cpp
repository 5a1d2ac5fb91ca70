#include "tabor/topography/parameters.hpp"

#include <algorithm>

#include "tabor/core/error.hpp"
#include "tabor/topography/parameters/sets.hpp"

namespace tabor::topography {
namespace {

constexpr std::array<std::string_view, kParameterSets.size()> kSetNames{
    "height", "hybrid", "function", "volume", "spatial", "feature", "spectral", "profile"};

std::vector<Parameter> of_set(const Topography& topography, ParameterSet set,
                              const ParameterOptions& options) {
  switch (set) {
    case ParameterSet::height:
      return height_parameters(topography);
    case ParameterSet::hybrid:
      return hybrid_parameters(topography, options);
    default:
      return {};
  }
}

}  // namespace

std::optional<ParameterSet> parameter_set_from(std::string_view name) {
  const auto* found = std::find(kSetNames.begin(), kSetNames.end(), name);
  if (found == kSetNames.end()) return std::nullopt;
  return kParameterSets[static_cast<std::size_t>(found - kSetNames.begin())];
}

std::string_view name_of(ParameterSet set) { return kSetNames[static_cast<std::size_t>(set)]; }

std::vector<Parameter> parameters(const Topography& topography, const ParameterOptions& options,
                                  const Observer& observer) {
  if (topography.height.isNaN().all()) {
    throw InputError("surface parameters", "a surface of holes only", "some valid heights", "");
  }
  std::vector<Parameter> all;
  for (const ParameterSet set : options.sets) {
    report_progress(observer, std::string(name_of(set)) + " parameters", kNoValue);
    for (Parameter& parameter : of_set(topography, set, options)) {
      parameter.set = set;
      all.push_back(std::move(parameter));
    }
  }
  return all;
}

}  // namespace tabor::topography
