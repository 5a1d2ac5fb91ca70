#pragma once

#include <string>
#include <vector>

#include "tabor/io/json.hpp"
#include "tabor/metrology/parameter.hpp"
#include "tabor/metrology/parameter_means.hpp"

// Prints the roughness parameters of one scan, of several side by side, or of groups, as text, CSV
// and JSON.
namespace tabor::cli {

/// Parameters of one scan of a batch, or why it has none.
struct ScanParameters {
  std::string path;
  std::string treatment;                              ///< the filter chain, "none" without
  std::vector<metrology::Parameter> parameters = {};  ///< empty if the scan failed
  std::string failure = {};                           ///< why there are none
};

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
std::string comparison_table(const std::vector<ScanParameters>& scans);

/// Returns one row per scan, one column "symbol [SI unit]" per parameter; empty where there is no
/// value.
std::string csv_table(const std::vector<ScanParameters>& scans);

/// Means of one group of scans.
struct GroupParameters {
  std::string name;
  std::vector<std::string> scans;  ///< that were measured
  std::vector<metrology::ParameterMean> means;
};

/// Returns one row per parameter: mean, standard deviation and number of scans.
std::string group_table(const GroupParameters& group);
/// Returns one row per group and parameter, SI: the means, then a column per scan of any group,
/// empty for scans of another group.
std::string csv_table(const std::vector<GroupParameters>& groups,
                      const std::vector<ScanParameters>& scans);
/// Returns {"group", "scans", "parameters": {"Sq": {"mean", "std", "sem", "n", "unit"}, ...}}
io::Json json_of(const GroupParameters& group);

/// Returns {"Sq": {"value", "unit", "definition", "note", "set"}, ...}
io::Json json_of(const std::vector<metrology::Parameter>& parameters);

}  // namespace tabor::cli
