#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tabor/scan/formats/format.hpp"

namespace tabor::scan::format {

/// What the lines before the numbers say. Lengths in metres.
struct TextHeader {
  std::string channel;
  std::string unit;              ///< of the heights
  double scale = 1;              ///< stored number -> unit
  std::optional<double> width;   ///< of the whole map
  std::optional<double> height;  ///< of the whole map
  std::optional<double> pixel;   ///< square pixels
  std::optional<double> nx;
  std::optional<double> ny;
  struct Column {
    char name = '?';  ///< x, y, z or something else
    std::string unit = {};
  };
  std::vector<Column> columns;  ///< from the left, if they are named
  bool one_per_line = false;    ///< Nanoscope export: a square map without line structure
  bool is_map = false;          ///< the header describes a map: no coordinate columns
  std::size_t n_lines = 0;      ///< header lines

  /// Once the number of columns is known: a header of more words than columns ends in a remark.
  void fit_columns(std::size_t n_columns);
  std::optional<std::size_t> column(char name) const;  ///< its place among the columns
  bool names_places() const { return column('x') && column('y'); }
};

/// True for a line that a known header can have before its numbers.
bool is_header_line(std::string_view line);

/// Reads and removes the header from `text`; throws Unrecognised for a line that is none. Knows
/// Gwyddion's (English, German), Wyko's and Nanoscope's text exports and lines with column names
/// such as "x [um], y [um], z [nm]".
TextHeader take_header(const Contents& contents, std::string_view& text);

}  // namespace tabor::scan::format
