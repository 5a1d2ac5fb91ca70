#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

// Defines a roughness parameter as a number with its symbol, unit and definition, and the sets of
// parameters.
namespace tabor::metrology {

/// Sets of parameters: those of ISO 25178-2, then spectral moments and profiles.
enum class ParameterSet { height, hybrid, function, volume, spatial, feature, spectral, profile };

inline constexpr std::array kParameterSets{
    ParameterSet::height,  ParameterSet::hybrid,  ParameterSet::function, ParameterSet::volume,
    ParameterSet::spatial, ParameterSet::feature, ParameterSet::spectral, ParameterSet::profile};

std::optional<ParameterSet> parameter_set_from(std::string_view name);  ///< "height", ...
std::string_view name_of(ParameterSet set);

/// Roughness parameter with everything needed to compare it with another program's.
struct Parameter {
  std::string symbol;      ///< "Sq"
  double value = 0;        ///< SI; NaN where it does not exist (Ssk of a flat surface)
  std::string unit;        ///< "m", "1", "%", "deg", "1/m^2", ...
  std::string definition;  ///< formula and convention, one line
  std::string note = {};   ///< a bound ("< 0.05: ..."), a warning, or why there is no value
  ParameterSet set = ParameterSet::height;  ///< filled in by parameters()
};

}  // namespace tabor::metrology
