// Text files of profiles with a header of their own: HFM ("X;Y;valid") and the CSV of Veeco's and
// Bruker's Dektak ("Scan Data" above the points), as SurfaceTopography describes them (IO/XYZ.py).
#include <fmt/format.h>

#include "tabor/core/text.hpp"
#include "tabor/core/units.hpp"
#include "tabor/scan/formats/profile.hpp"
#include "tabor/scan/formats/readers.hpp"
#include "tabor/scan/formats/text_numbers.hpp"

namespace tabor::scan::format {
namespace {

constexpr std::string_view kHfm = "X;Y;valid";
constexpr std::string_view kScanData = "\nScan Data";

/// Units, separator and points of a file.
struct Points {
  std::string unit_x;
  std::string unit_z;
  char separator = ';';
  std::string_view lines;
  bool has_valid = false;  ///< a third column is 0 where the height is not valid
};

/// The unit of length in a column's name: "Lateral um", "Raw Micrometer", "[mm]"; "" if none is.
std::string unit_in(const std::string& name) {
  static constexpr std::pair<std::string_view, const char*> names[]{
      {"micrometer", "um"}, {"nanometer", "nm"}, {"millimeter", "mm"}, {"angstrom", "angstrom"}};
  std::string blanks = name;
  for (char& c : blanks) c = std::string_view("[]()").find(c) == std::string_view::npos ? c : ' ';
  for (const std::string& word : split(blanks, ' ')) {
    for (const auto& [known, unit] : names) {
      if (lower(word) == known) return unit;
    }
    if (unit_factor(word, dimension::length)) return word;
  }
  return "";
}

std::string column(const std::string& line, char separator, std::size_t i) {
  const std::vector<std::string> columns = split(line, separator);
  return i < columns.size() ? columns[i] : "";
}

Points hfm_points(std::string_view text) {
  take_line(text);
  const std::string units(trim(take_line(text)));
  return {.unit_x = unit_in(column(units, ';', 0)),
          .unit_z = unit_in(column(units, ';', 1)),
          .separator = ';',
          .lines = text,
          .has_valid = true};
}

/// Behind "Scan Data" follow an empty line and the names of the columns.
Points dektak_points(std::string_view text) {
  text.remove_prefix(text.find(kScanData) + 1);
  take_line(text);
  std::string names;
  while (names.empty() && !text.empty()) names = std::string(trim(take_line(text)));
  return {.unit_x = unit_in(column(names, ',', 0)),
          .unit_z = unit_in(column(names, ',', 1)),
          .separator = ',',
          .lines = text};
}

EvenProfile profile_of(const Contents& contents, const Points& points) {
  std::vector<double> positions, heights;
  std::string_view rest = points.lines;
  while (!rest.empty()) {
    const std::string line(trim(take_line(rest)));
    if (line.empty()) continue;
    const auto x = parse_number(trim(column(line, points.separator, 0)));
    const auto z = parse_number(trim(column(line, points.separator, 1)));
    if (!x || !z) reject(contents, "'" + line.substr(0, 40) + "'", "a position and a height");
    const bool is_valid = !points.has_valid || trim(column(line, points.separator, 2)) != "0";
    positions.push_back(*x);
    heights.push_back(is_valid ? *z : kHole);
  }
  return even_profile(contents, std::move(positions), std::move(heights));
}

}  // namespace

Match identify_stylus_text(std::string_view head) {
  const bool is_dektak =
      head.find('\0') == std::string_view::npos && head.find(kScanData) != std::string_view::npos;
  return head.starts_with(kHfm) || is_dektak ? Match::yes : Match::no;
}

Document open_stylus_text(const Contents& contents) {
  const bool is_hfm = contents.bytes.starts_with(kHfm);
  const Points points = is_hfm ? hfm_points(contents.bytes) : dektak_points(contents.bytes);
  Document document{.format = "stylus-text", .instrument = is_hfm ? "" : "Dektak"};
  document.layers.push_back(
      profile_layer(profile_of(contents, points), points.unit_x, points.unit_z, document));
  return document;
}

}  // namespace tabor::scan::format
