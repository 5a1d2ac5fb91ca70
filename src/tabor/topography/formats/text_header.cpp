#include "tabor/topography/formats/text_header.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "tabor/core/text.hpp"
#include "tabor/core/units.hpp"
#include "tabor/topography/formats/text_numbers.hpp"

namespace tabor::topography::format {
namespace {

/// "10.00 µm" or "10,00 µm" in metres.
double length(const Contents& contents, std::string_view text) {
  text = trim(text);
  const std::size_t end = std::min(text.find_first_not_of("+-0123456789.,eE"), text.size());
  std::string digits(text.substr(0, end));
  std::replace(digits.begin(), digits.end(), ',', '.');
  const auto value = parse_number(digits);
  const auto factor = unit_factor(text.substr(end), dimension::length);
  if (!value || !factor || !(*value > 0)) {
    refuse(contents, fmt::format("'{}' in its header", text), "a length with its unit", kDamaged);
  }
  return *value * *factor;
}

double positive(const Contents& contents, std::string_view text) {
  const auto value = parse_number(text);
  if (!value || !(*value > 0)) {
    refuse(contents, fmt::format("'{}' in its header", trim(text)), "a positive number", kDamaged);
  }
  return *value;
}

/// Gwyddion's "# Key: value" lines, English and German.
void read_comment(const Contents& contents, std::string_view line, TextHeader& header) {
  const std::size_t colon = line.find(':');
  if (colon == std::string_view::npos) return;
  const std::string key =
      lower(trim(line.substr(line.find_first_not_of("# "), colon - line.find_first_not_of("# "))));
  const std::string_view value = trim(line.substr(colon + 1));
  if (key == "channel" || key == "kanal") header.channel = value;
  if (key == "width" || key == "breite") header.width = length(contents, value);
  if (key == "height" || key == "höhe") header.height = length(contents, value);
  if (key == "value units" || key.starts_with("wert")) header.unit = value;
  header.is_map = header.is_map || header.width.has_value();
}

/// Wyko's "key=value" lines; the first line has two of them.
void read_assignment(const Contents& contents, std::string_view line, TextHeader& header) {
  const std::size_t equals = line.find('=');
  const std::string key = lower(trim(line.substr(0, equals)));
  const std::string_view value = trim(line.substr(equals + 1));
  header.is_map = true;
  if (key == "h") {
    header.ny = positive(contents, value.substr(0, value.find(' ')));
    const std::size_t second = value.find("w=");
    if (second != std::string_view::npos) {
      header.nx = positive(contents, value.substr(second + 2));
    }
  }
  if (key == "pixel size") header.pixel = length(contents, value);
  if (key == "data unit" && header.unit.empty()) header.unit = value;
  if (key.starts_with("height conversion factor")) {
    header.scale = positive(contents, value);
    const std::size_t arrow = key.find("->");
    const std::size_t bracket = key.find(')');
    if (arrow != std::string::npos && bracket != std::string::npos) {
      header.unit = trim(std::string_view(key).substr(arrow + 2, bracket - arrow - 2));
    }
  }
}

bool is_word_start(std::string_view line, std::size_t at) {
  return at == 0 || std::isalnum(static_cast<unsigned char>(line[at - 1])) == 0;
}

/// The unit of column "x" in "x_um z_um", "x [um], y [um]", "X(mm);Y(mm)"; "" if there is none.
std::string column_unit(std::string_view line, char column) {
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    if (std::tolower(static_cast<unsigned char>(line[i])) != column || !is_word_start(line, i)) {
      continue;
    }
    std::string_view rest = line.substr(i + 1);
    while (rest.starts_with(' ')) rest.remove_prefix(1);
    if (rest.empty() || std::string_view("_[(/").find(rest.front()) == std::string_view::npos) {
      continue;
    }
    rest.remove_prefix(1);
    return std::string(rest.substr(0, rest.find_first_of(" ,;\t\r])")));
  }
  return "";
}

void read_column_names(std::string_view line, TextHeader& header) {
  const std::string z = column_unit(line, 'z');
  if (z.empty()) return;
  header.unit = z;
  header.x_unit = column_unit(line, 'x');
  header.y_unit = column_unit(line, 'y');
}

bool is_assignment(const std::string& line) {
  return line.starts_with("h=") || line.starts_with("pixel size=") ||
         line.starts_with("data unit=") || line.starts_with("height conversion factor");
}

}  // namespace

bool is_header_line(std::string_view line) {
  const std::string text = lower(trim(line));
  return text.empty() || text.starts_with('#') || text.starts_with("\\exported image units") ||
         text.starts_with("//") || is_assignment(text) || !column_unit(text, 'z').empty() ||
         text.starts_with("x,") || text.starts_with("x;") || text.starts_with("x\t") ||
         text.starts_with("x ");
}

TextHeader take_header(const Contents& contents, std::string_view& text) {
  constexpr std::string_view kNanoscope = "\\Exported image units:";
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);  // byte order mark
  TextHeader header;
  const char line_end = line_end_of(text);
  while (!text.empty()) {
    std::string_view rest = text;
    const std::string_view line = trim(take_line(rest, line_end));
    if (starts_with_number(line)) return header;
    if (!is_header_line(line)) {
      refuse(contents, fmt::format("'{}' on line {}", line.substr(0, 40), header.n_lines + 1),
             "numbers or a known header", "start lines that are not data with #");
    }
    if (line.starts_with(kNanoscope)) {
      header.unit = trim(line.substr(kNanoscope.size()));
      header.one_per_line = true;
    } else if (is_assignment(lower(line))) {
      read_assignment(contents, line, header);
    } else if (line.starts_with('#')) {
      read_comment(contents, line, header);
    }
    if (!header.is_map) read_column_names(line, header);
    text = rest;
    ++header.n_lines;
  }
  return header;
}

}  // namespace tabor::topography::format
