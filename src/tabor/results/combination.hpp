#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tabor/comparison/combine.hpp"
#include "tabor/io/text/json.hpp"
#include "tabor/results/fields_file.hpp"

// Turns the combination of two scans into numbers by name, warnings and a result file.
namespace tabor::results {

/// Returns shift, registration (null where nothing was searched), size of the overlap, rms heights
/// and, for wear, its volumes.
io::Json values_of(const comparison::Combination& combination);

/// Returns warnings: a texture that fits at several shifts, holes that exclude much of the overlap.
std::vector<std::string> doubts_of(const comparison::Combination& combination);

/// A combination as its file holds it.
struct StoredCombination {
  const topography::Topography& map;
  std::string mode;
  io::Json values;  ///< of values_of()
};

/// Writes the HDF5 file of docs/results.md: the map as /surface; as attributes of /combination the
/// mode and every number, those of a volume under its name: worn_volume_m3.
void write_combination(const StoredCombination& combination, const ResultHead& head,
                       const std::vector<Finding>& warnings, const std::filesystem::path& file);

}  // namespace tabor::results
