#include "tabor/scan/formats/text_header.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "tabor/core/text.hpp"
#include "tabor/core/units.hpp"
#include "tabor/scan/formats/text_numbers.hpp"

namespace tabor::scan::format {
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
    reject(contents, fmt::format("'{}' in its header", text), "a length with its unit", kDamaged);
  }
  return *value * *factor;
}

double positive(const Contents& contents, std::string_view text) {
  const auto value = parse_number(text);
  if (!value || !(*value > 0)) {
    reject(contents, fmt::format("'{}' in its header", trim(text)), "a positive number", kDamaged);
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
  if (key == "height" || key == "höhe" || key == "h\xf6he") header.height = length(contents, value);
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
    if (second != std::string_view::npos) header.nx = positive(contents, value.substr(second + 2));
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

using Column = TextHeader::Column;

/// Splits "x [um], y [um], z [nm]", "X(mm);Y(mm)" or "x_um z_um"; a unit in brackets belongs to the
/// word before it.
std::vector<std::string> column_labels(std::string_view line, char separator) {
  std::vector<std::string> labels;
  for (const std::string& part : split(line, separator)) {
    const std::string_view label = trim(part);
    if (label.empty()) continue;
    const bool is_unit = label.starts_with('[') || label.starts_with('(');
    if (is_unit && !labels.empty()) {
      labels.back() += label;
    } else {
      labels.emplace_back(label);
    }
  }
  return labels;
}

/// Whether the text may stand where a unit does: "um", not "512" or "of my own".
bool is_unit_like(std::string_view text) {
  return text.empty() ||
         (text.find(' ') == std::string_view::npos && text.front() > '9' && text.front() != ':');
}

/// x, y or z with its unit; '?' for every other label and for remarks such as "Height (um): 3".
Column column_of(std::string_view label) {
  const std::size_t end = std::min(label.find_first_of("_[(/"), label.size());
  std::string name = lower(trim(label.substr(0, end)));
  name = name.substr(name.find_last_of(" :") + 1);  // of "points: x [um]"
  Column column;
  if (end < label.size()) {
    const std::string_view rest = label.substr(end + 1);
    const std::size_t close = std::min(rest.find_first_of("])"), rest.size());
    column.unit = trim(rest.substr(0, close));
    const bool is_end = close == rest.size() || trim(rest.substr(close + 1)).empty();
    if (!is_end || !is_unit_like(column.unit)) return {};
  }
  if (name == "x" || name == "y" || name == "z") column.name = name[0];
  if (name == "height" || name == "höhe" || name == "h\xf6he") column.name = 'z';
  return column;
}

bool has(const std::vector<Column>& columns, char name) {
  return std::any_of(columns.begin(), columns.end(),
                     [name](const Column& column) { return column.name == name; });
}

std::size_t n_leading_known(const std::vector<Column>& columns) {
  const auto end = std::find_if(columns.begin(), columns.end(),
                                [](const Column& column) { return column.name == '?'; });
  return static_cast<std::size_t>(end - columns.begin());
}

/// The columns that a line so separated names: at least two of x, y and z first, or x, y and z
/// anywhere, or z with its unit. A remark may follow.
std::vector<Column> columns_of(std::string_view line, char separator) {
  std::vector<Column> columns;
  for (const std::string& label : column_labels(line, separator)) {
    if (columns.empty() && label.ends_with(':')) continue;  // "points: x [um]"
    const Column column = column_of(label);
    if (column.name != '?' && has(columns, column.name)) break;
    columns.push_back(column);
  }
  const std::size_t n_known = n_leading_known(columns);
  const bool names_all = has(columns, 'x') && has(columns, 'y') && has(columns, 'z');
  const bool names_height = std::any_of(columns.begin(), columns.end(), [](const Column& column) {
    return column.name == 'z' && !column.unit.empty();
  });
  const bool is_word_of_remark = separator == ' ' && n_known == 0;
  const bool holds = n_known > 1 || names_all || (names_height && !is_word_of_remark);
  return holds ? columns : std::vector<Column>{};
}

std::vector<Column> columns_of(std::string_view line) {
  line.remove_prefix(std::min(line.find_first_not_of("#/ \t"), line.size()));
  if (line.find('=') != std::string_view::npos) return {};  // "Height [um] = 3"
  for (const char separator : {';', '\t', ','}) {
    if (line.find(separator) == std::string_view::npos) continue;
    if (auto columns = columns_of(line, separator); !columns.empty()) return columns;
  }
  std::string words(line);
  std::replace(words.begin(), words.end(), ',', ' ');  // "x,y [mm] z [um]"
  return columns_of(words, ' ');
}

/// A later line that says less about units changes nothing.
void read_columns(std::string_view line, TextHeader& header) {
  std::vector<Column> columns = columns_of(line);
  const bool has_units = std::any_of(columns.begin(), columns.end(), [](const Column& column) {
    return column.name != '?' && !column.unit.empty();
  });
  if (columns.empty() || (!header.columns.empty() && !has_units)) return;
  header.columns = std::move(columns);
  for (const Column& column : header.columns) {
    if (column.name == 'z' && !column.unit.empty()) header.unit = column.unit;
  }
}

bool is_assignment(const std::string& line) {
  return line.starts_with("h=") || line.starts_with("pixel size=") ||
         line.starts_with("data unit=") || line.starts_with("height conversion factor");
}

}  // namespace

bool is_header_line(std::string_view line) {
  const std::string text = lower(trim(line));
  return text.empty() || text.starts_with('#') || text.starts_with("\\exported image units") ||
         text.starts_with("//") || is_assignment(text) || !columns_of(text).empty();
}

void TextHeader::fit_columns(std::size_t n_columns) {
  if (columns.size() != n_columns) columns.resize(std::min(n_leading_known(columns), n_columns));
}

std::optional<std::size_t> TextHeader::column(char name) const {
  const auto found = std::find_if(columns.begin(), columns.end(),
                                  [name](const Column& column) { return column.name == name; });
  if (found == columns.end()) return std::nullopt;
  return static_cast<std::size_t>(found - columns.begin());
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
      if (contents.bytes.find('\0') != std::string_view::npos) {
        throw Unrecognised(contents, "binary data behind a head of text", "");
      }
      throw Unrecognised(
          contents,
          fmt::format("text with '{}' on line {}", line.substr(0, 40), header.n_lines + 1),
          "begin every line that holds no numbers with #");
    }
    if (line.starts_with(kNanoscope)) {
      header.unit = trim(line.substr(kNanoscope.size()));
      header.one_per_line = true;
    } else if (is_assignment(lower(line))) {
      read_assignment(contents, line, header);
    } else if (line.starts_with('#')) {
      read_comment(contents, line, header);
    }
    if (!header.is_map) read_columns(line, header);
    text = rest;
    ++header.n_lines;
  }
  return header;
}

}  // namespace tabor::scan::format
