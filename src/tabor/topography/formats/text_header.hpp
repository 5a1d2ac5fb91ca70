#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "tabor/topography/formats/format.hpp"

namespace tabor::topography::format {

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
  std::string x_unit;  ///< of coordinate columns
  std::string y_unit;
  bool one_per_line = false;  ///< Nanoscope export: a square map without line structure
  bool is_map = false;        ///< the header describes a map: no coordinate columns
  std::size_t n_lines = 0;    ///< header lines
};

/// True for a line that a known header can have before its numbers.
bool is_header_line(std::string_view line);

/// Reads and removes the header from `text`. Knows Gwyddion's (English, German), Wyko's and
/// Nanoscope's text exports and lines with column names such as "x [um], y [um], z [nm]".
TextHeader take_header(const Contents& contents, std::string_view& text);

}  // namespace tabor::topography::format
