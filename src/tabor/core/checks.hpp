#pragma once

#include <string>

namespace tabor {

/// Throws InputError unless the value is finite and above zero. `unit`: of the value, "" if it has
/// none.
void check_positive(const std::string& what, double value, const std::string& unit = "");

}  // namespace tabor
