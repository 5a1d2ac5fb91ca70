#include "tabor/metrology/areal/parameters.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "tabor/core/error.hpp"
#include "tabor/core/watch.hpp"
#include "tabor/metrology/areal/abbott.hpp"
#include "tabor/metrology/areal/sets.hpp"
#include "tabor/metrology/features/features.hpp"
#include "tabor/numerics/field_statistics.hpp"

namespace tabor::metrology {
namespace {

constexpr std::array<std::string_view, kParameterSets.size()> kSetNames{
    "height", "hybrid", "function", "volume", "spatial", "feature", "spectral", "profile"};

bool needs_curve(ParameterSet set) {
  return set == ParameterSet::function || set == ParameterSet::volume;
}

/// The surface itself, or the copy with heights of exactly zero of one whose heights differ by
/// rounding alone: what is made of rounding is no roughness.
const topography::Topography& without_rounding(const topography::Topography& topography,
                                               std::optional<topography::Topography>& copy) {
  if (!numerics::is_flat(topography.height)) return topography;
  copy = topography;
  copy->height = topography.height.isNaN().select(topography.height, 0);
  return *copy;
}

/// Computes set by set and keeps the sorted heights between the two sets that share them.
class Calculation {
 public:
  Calculation(const topography::Topography& topography, const ParameterOptions& options,
              const Observer& observer)
      : topography_(topography), options_(options), observer_(observer) {}

  std::vector<Parameter> of(ParameterSet set) {
    const Watch watch(observer_, std::string(name_of(set)) + " parameters");
    if (!needs_curve(set)) curve_.reset();
    switch (set) {
      case ParameterSet::height:
        return height_parameters(topography_);
      case ParameterSet::hybrid:
        return hybrid_parameters(topography_, options_);
      case ParameterSet::function:
        return function_parameters(curve(), options_);
      case ParameterSet::volume:
        return volume_parameters(curve(), options_);
      case ParameterSet::spatial:
        return spatial_parameters(topography_, options_, observer_);
      case ParameterSet::spectral:
        return spectral_parameters(topography_);
      case ParameterSet::feature:
        return feature_parameters(topography_, {.pruning = options_.pruning}, observer_);
      case ParameterSet::profile:
        return profile_parameters(topography_, profile_options(), observer_);
    }
    return {};
  }

 private:
  /// A profile's c is that of the area unless it has its own.
  ProfileOptions profile_options() const {
    ProfileOptions options = options_.profile;
    if (!options.ratio_height) options.ratio_height = options_.smr_height;
    return options;
  }

  const AbbottCurve& curve() {
    if (!curve_) curve_.emplace(topography_.height, observer_);
    return *curve_;
  }

  const topography::Topography& topography_;
  const ParameterOptions& options_;
  const Observer& observer_;
  std::optional<AbbottCurve> curve_;
};

void check_share(const char* what, double value, double largest) {
  if (!(value > 0 && value < largest)) {
    throw InputError(what, fmt::format("{:g}", value),
                     fmt::format("a number between 0 and {:g}", largest), "");
  }
}

void check(const ParameterOptions& options) {
  check_share("material ratio p", options.peak_ratio, 100);
  check_share("material ratio q", options.valley_ratio, 100);
  check_share("ACF threshold s", options.acf_threshold, 1);
  if (!std::isfinite(options.smr_height)) {
    throw InputError("height c of Smr(c)", fmt::format("{:g} m", options.smr_height), "a height",
                     "");
  }
  if (options.peak_ratio >= options.valley_ratio) {
    throw InputError(
        "material ratios",
        fmt::format("p = {:g} %, q = {:g} %", options.peak_ratio, options.valley_ratio), "p < q",
        "");
  }
}

}  // namespace

std::optional<ParameterSet> parameter_set_from(std::string_view name) {
  const auto* found = std::find(kSetNames.begin(), kSetNames.end(), name);
  if (found == kSetNames.end()) return std::nullopt;
  return kParameterSets[static_cast<std::size_t>(found - kSetNames.begin())];
}

std::string_view name_of(ParameterSet set) { return kSetNames[static_cast<std::size_t>(set)]; }

std::vector<Parameter> parameters(const topography::Topography& topography,
                                  const ParameterOptions& options, const Observer& observer) {
  check(options);
  if (topography.height.isNaN().all()) {
    throw InputError("surface parameters", "a surface of holes only", "some valid heights", "");
  }
  std::optional<topography::Topography> copy;
  Calculation calculation(without_rounding(topography, copy), options, observer);
  std::vector<Parameter> all;
  for (const ParameterSet set : options.sets) {
    for (Parameter& parameter : calculation.of(set)) {
      parameter.set = set;
      all.push_back(std::move(parameter));
    }
  }
  return all;
}

}  // namespace tabor::metrology
