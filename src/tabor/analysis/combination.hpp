#pragma once

#include <string>
#include <vector>

#include "tabor/comparison/combine.hpp"
#include "tabor/io/json.hpp"

// Two scans put together, as a result: numbers by name and reasons to doubt them.
namespace tabor::analysis {

/// Shift, registration (null where nothing was searched), size of the overlap, rms heights and,
/// for wear, its volumes.
io::Json values_of(const comparison::Combination& combination);

/// A texture that fits at several shifts; holes that leave much of the overlap out.
std::vector<std::string> doubts_of(const comparison::Combination& combination);

}  // namespace tabor::analysis
