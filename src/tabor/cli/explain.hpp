#pragma once

#include <string>
#include <vector>

#include "tabor/cli/verb.hpp"

// Handles `--explain CODE`, which prints what docs/warnings.md says about one warning.
namespace tabor::cli {

/// The option "--explain CODE", before or after any verb.
inline constexpr const char* kExplain = "--explain";
bool asks_to_explain(const std::vector<std::string>& words);

/// Prints what docs/warnings.md says of the code of a warning; returns the exit code. Throws
/// UsageError for a code that does not exist and for none.
int explain(const std::vector<std::string>& words, Context& context);

}  // namespace tabor::cli
