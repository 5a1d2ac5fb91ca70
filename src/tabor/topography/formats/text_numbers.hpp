#pragma once

#include <string_view>
#include <vector>

#include "tabor/topography/formats/format.hpp"

namespace tabor::topography::format {

/// Numbers of a text file, line after line.
struct TextNumbers {
  std::vector<double> values;        ///< NaN = hole (NaN, NM, BAD, an empty field, ...)
  std::vector<std::size_t> columns;  ///< numbers on each line that has any
  std::vector<std::size_t> lines;    ///< and its number in the file, from 1

  bool is_rectangular() const;
  std::size_t n_columns() const { return columns.empty() ? 0 : columns.front(); }
};

/// True if the line starts with a number or with a word for a missing value.
bool starts_with_number(std::string_view line);

/// Removes the first line from `text` and returns it without its end.
std::string_view take_line(std::string_view& text);

/// Parses all of `text`, whose first line is line `first_line` of the file. Fields are separated by
/// blanks, tabs, ';' or ','; where ',' must be a decimal comma it is one. Throws InputError with
/// the line of the first field that is no number.
TextNumbers parse_numbers(const Contents& contents, std::string_view text, std::size_t first_line);

}  // namespace tabor::topography::format
