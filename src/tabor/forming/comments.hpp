#pragma once

#include <string>
#include <vector>

#include "tabor/forming/friction_table.hpp"
#include "tabor/forming/unit_system.hpp"

// Writes the numbers and comment lines that the decks of all forming codes share.
namespace tabor::forming {

/// Returns a number with as many digits as every column of every format holds and as are
/// significant: "2", "4.5e-13".
std::string digits(double value);

/// Returns the head of every deck: program and version, origin, units, ranges, what is left out.
/// Throws InputError for a table without numbers.
std::vector<std::string> head_of(const FrictionTable& table, const UnitSystem& units,
                                 const std::string& program);

/// Returns comment lines, each after `mark` and no longer than 80 columns; long ones continue,
/// indented, on the next line. Control characters are made visible: no text of a file begins a
/// card.
std::string comments(const std::string& mark, const std::vector<std::string>& lines);

/// Returns "lubricant density 4.5e-13 t/mm^2 (0.45 g/m^2)".
std::string density_text(double lubricant_density, const UnitSystem& units);

}  // namespace tabor::forming
