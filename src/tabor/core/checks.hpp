#pragma once

#include <string>

namespace tabor {

/// Both throw InputError unless the value is finite and above zero, or not below it. `unit`: of the
/// value, "" if it has none.
void check_positive(const std::string& what, double value, const std::string& unit = "");
void check_not_negative(const std::string& what, double value, const std::string& unit = "");

}  // namespace tabor
