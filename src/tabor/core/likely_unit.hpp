#pragma once

#include <string>
#include <string_view>

#include "tabor/core/units.hpp"

// Guesses the unit that a user left out, to show the corrected form in the error message.
namespace tabor {

/// Value as a user would write it: "70" and "GPa".
struct WrittenValue {
  std::string number;
  std::string unit;

  /// Returns one word of a command line: "70GPa", "2e-8/Pa".
  std::string as_word() const;
  /// Returns a value in a file: "70 GPa", "2e-8 1/Pa".
  std::string as_text() const;
};

/// Returns an ordinary value of an option or a key ("--youngs-modulus", "case.toml:3:
/// ball.radius"). Its name tells more than its dimension: a Young's modulus is given in GPa, a mean
/// pressure in MPa.
WrittenValue example_value(std::string_view name, Dimension dimension);

/// Returns `number`, given without a unit, with the unit that makes it an ordinary value;
/// example_value() if no unit does.
WrittenValue with_likely_unit(std::string_view number, std::string_view name, Dimension dimension);

}  // namespace tabor
