#pragma once

#include <string>
#include <vector>

#include "tabor/cases/surface_parameters.hpp"

// Prints the roughness parameters of one scan, of several side by side, or of groups, as tables.
namespace tabor::cli {

/// A length, area, volume or density in a unit that is easy to read.
struct ReadableUnit {
  double factor = 1;  ///< readable value = factor * SI value
  std::string name;   ///< "µm", "1/mm²", "" for plain numbers
};

/// Returns the unit in which `largest` (SI, of the unit "m", "m^2", "1/m^2", "m^3/m^2", ...) is at
/// least 1.
ReadableUnit readable_unit(const std::string& si_unit, double largest);

/// Returns symbol, value with unit and definition, one table per set.
std::string grouped_table(const std::vector<metrology::Parameter>& parameters);

/// Returns a row per parameter, a column per scan that has any, all in the row's unit; for exactly
/// two scans also their ratio, or their difference where a ratio is meaningless (per cent, angles,
/// signed numbers).
std::string comparison_table(const std::vector<cases::ParametersRecord>& scans);

/// Returns one row per parameter: mean, standard deviation and number of scans.
std::string group_table(const cases::GroupParameters& group);

}  // namespace tabor::cli
