#pragma once

#include <string>
#include <vector>

#include "tabor/forming/friction_table.hpp"
#include "tabor/forming/unit_system.hpp"

namespace tabor::forming {

/// The digits that every column of every format holds and no number of ours exceeds in meaning:
/// "2", "4.5e-13".
std::string digits(double value);

/// What every deck says of itself: program and version, origin, units, ranges, what is left out.
std::vector<std::string> head_of(const FrictionTable& table, const UnitSystem& units,
                                 const std::string& program);

/// Comment lines, each behind `mark` and no longer than 80 columns; long ones go on, indented, in
/// the next. Control characters are made visible: no text of a file begins a card.
std::string comments(const std::string& mark, const std::vector<std::string>& lines);

/// "lubricant density 4.5e-13 t/mm^2 (0.45 g/m^2)"
std::string density_text(double lubricant_density, const UnitSystem& units);

}  // namespace tabor::forming
