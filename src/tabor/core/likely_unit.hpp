#pragma once

#include <string>
#include <string_view>

#include "tabor/core/units.hpp"

namespace tabor {

/// A value as somebody would write it: "70" and "GPa".
struct WrittenValue {
  std::string number;
  std::string unit;

  /// "70GPa", "2e-8/Pa": one word of a command line.
  std::string as_word() const;
  /// "70 GPa", "2e-8 1/Pa": a value in a file.
  std::string as_text() const;
};

/// An ordinary value of what `name` stands for, an option or a key of a file ("--youngs-modulus",
/// "case.toml:3: ball.radius"): its words tell more than its dimension, a Young's modulus is given
/// in GPa and a mean pressure in MPa.
WrittenValue example_value(std::string_view name, Dimension dimension);

/// `number`, given without a unit, in the unit that makes an ordinary value of it; example_value()
/// if none does.
WrittenValue with_likely_unit(std::string_view number, std::string_view name, Dimension dimension);

}  // namespace tabor
