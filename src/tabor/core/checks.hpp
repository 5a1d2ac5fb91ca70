#pragma once

#include <string>

// Checks that a number is finite and has the required sign, and names it in the error message.
namespace tabor {

/// Throw InputError unless the value is finite and above zero, or not below zero. `unit` of the
/// value: "" if it has none.
void check_positive(const std::string& what, double value, const std::string& unit = "");
void check_not_negative(const std::string& what, double value, const std::string& unit = "");

}  // namespace tabor
