#pragma once

#include <string>
#include <vector>

#include "tabor/cases/surface_parameters.hpp"
#include "tabor/io/text/json.hpp"

// Writes the roughness parameters of scans and of groups of scans as CSV and JSON.
namespace tabor::results {

/// Returns headings for scans that stand side by side: file names, or whole paths where names are
/// the same.
std::vector<std::string> headings(const std::vector<std::string>& files);

/// Returns one row per scan, one column "symbol [SI unit]" per parameter; empty where there is no
/// value.
std::string csv_of(const std::vector<cases::ParametersRecord>& scans);
/// Returns one row per group and parameter, SI: the means, then a column per scan of any group,
/// empty for scans of another group. Without groups, a row per scan as above.
std::string csv_of(const std::vector<cases::GroupParameters>& groups,
                   const std::vector<cases::ParametersRecord>& scans);

/// Returns {"Sq": {"value", "unit", "definition", "set", "note"}, ...}
io::Json json_of(const std::vector<metrology::Parameter>& parameters);
/// Returns {"group", "scans", "parameters": {"Sq": {"mean", "std", "sem", "n", "unit"}, ...}}
io::Json json_of(const cases::GroupParameters& group);

}  // namespace tabor::results
