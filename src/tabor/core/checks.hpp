#pragma once

#include <string>

// Checks that a number is finite and has the required sign, or that memory is free, and says in the
// error message what is not.
namespace tabor {

/// Throw InputError unless the value is finite and above zero, or not below zero. `unit` of the
/// value: "" if it has none.
void check_positive(const std::string& what, double value, const std::string& unit = "");
void check_not_negative(const std::string& what, double value, const std::string& unit = "");

/// Throws InputError unless so many bytes of memory are free, as far as the system says: `got`,
/// such as a number of pixels, is what would take them. Call it before work that takes long.
void check_memory(const std::string& what, const std::string& got, double bytes,
                  const std::string& remedy);

}  // namespace tabor
