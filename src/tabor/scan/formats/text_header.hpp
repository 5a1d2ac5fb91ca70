#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tabor/scan/formats/format.hpp"

// Reads the headers of text exports: channel, unit, size and column names.
namespace tabor::scan::format {

/// Content of the lines before the numbers. Lengths in metres.
struct TextHeader {
  std::string channel;
  std::string unit;              ///< of the heights
  double scale = 1;              ///< stored number -> unit
  double offset = 0;             ///< in `unit`, added to the scaled number
  std::optional<double> width;   ///< of the whole map; an impossible one stays as it is
  std::optional<double> height;  ///< of the whole map
  std::optional<double> pixel_x;
  std::optional<double> pixel_y;
  std::string said_x, said_y;  ///< the header's words for width and height, or the pixels
  std::string pixel_hint;      ///< why the header gives none
  std::optional<double> nx;
  std::optional<double> ny;
  double n_void = 0;  ///< SPIP: a second map behind the heights tells these
  struct Column {
    char name = '?';  ///< x, y, z or something else
    std::string unit = {};
  };
  std::vector<Column> columns;  ///< from the left, if they are named
  bool one_per_line = false;    ///< Nanoscope export: a square map without line structure
  bool is_map = false;          ///< the header describes a map: no coordinate columns
  std::size_t n_lines = 0;      ///< header lines

  /// Drops surplus column names once the number of columns is known: a header of more words than
  /// columns ends in a remark.
  void fit_columns(std::size_t n_columns);
  std::optional<std::size_t> column(char name) const;  ///< its place among the columns
  bool names_places() const { return column('x') && column('y'); }
};

/// True for a line that a known header can have before its numbers.
bool is_header_line(std::string_view line);

/// True where a comment after numbers begins the header of other numbers: it gives their channel,
/// size or columns.
bool begins_section(std::string_view comment);

/// Reads and removes the header from `text`, whose first line has this number; throws Unrecognised
/// for a line that is none. Knows the text exports of Gwyddion (in eight languages), SPIP,
/// Attocube, Nova, Wyko and Nanoscope and lines with column names such as "x [um], y [um], z [nm]".
TextHeader take_header(const Contents& contents, std::string_view& text, std::size_t first_line);

}  // namespace tabor::scan::format
