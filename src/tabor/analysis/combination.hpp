#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tabor/analysis/fields_file.hpp"
#include "tabor/comparison/combine.hpp"
#include "tabor/io/json.hpp"

// Two scans put together, as a result: numbers by name and reasons to doubt them.
namespace tabor::analysis {

/// Shift, registration (null where nothing was searched), size of the overlap, rms heights and,
/// for wear, its volumes.
io::Json values_of(const comparison::Combination& combination);

/// A texture that fits at several shifts; holes that leave much of the overlap out.
std::vector<std::string> doubts_of(const comparison::Combination& combination);

/// The HDF5 file of docs/results.md: the map as /surface; as attributes of /combination the mode
/// and every number of values_of(), those of a volume under its name: worn_volume_m3.
void write_combination(const comparison::Combination& combination, comparison::CombineMode mode,
                       const ResultHead& head, const std::vector<Finding>& warnings,
                       const std::filesystem::path& file);

}  // namespace tabor::analysis
