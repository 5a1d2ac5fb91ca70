#pragma once

#include <string>
#include <string_view>
#include <vector>

// Expands ranges of values as a user types them: "2MPa..15MPa:7", "0.1m/s..10m/s:log:5".
namespace tabor {

/// True where two numbers, with or without units, stand around "..": "../scan.x3p" is a file.
bool is_value_range(std::string_view text);

/// Returns the values of a range, each as a user would type it, in the unit of the first end,
/// rounded to six digits: linear unless ":log" says otherwise, five values unless ":N" says how
/// many. "2MPa..15MPa:3" -> 2 MPa, 8.5 MPa, 15 MPa. Throws InputError if the ends have different
/// dimensions, a logarithmic range reaches zero, or a part behind a colon is neither lin, log nor a
/// number of values.
std::vector<std::string> values_of_range(std::string_view text);

}  // namespace tabor
