#include "tabor/scan/formats/text_header.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "tabor/core/text.hpp"
#include "tabor/scan/formats/text_keys.hpp"
#include "tabor/scan/formats/text_numbers.hpp"

namespace tabor::scan::format {
namespace {

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

/// True if the text may stand where a unit does: "um", not "512" or "of my own".
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
/// anywhere, or z with its unit, or x with its unit beside others. A remark may follow.
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
  const bool names_x =
      columns.size() > 1 && columns.front().name == 'x' && !columns.front().unit.empty();
  const bool holds = n_known > 1 || names_all || names_x || (names_height && !is_word_of_remark);
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

}  // namespace

bool is_header_line(std::string_view line) {
  const std::string text = lower(trim(line));
  return text.empty() || text.starts_with('#') || text.starts_with("\\exported image units") ||
         text.starts_with("//") || is_assignment(text) || !columns_of(text).empty();
}

void TextHeader::fit_columns(std::size_t n_columns) {
  if (columns.size() == n_columns) return;
  columns.resize(std::min(n_leading_known(columns), n_columns));
  // "# x [um] of the stage": a remark, not a column.
  if (columns.size() == 1 && columns.front().name == 'x') columns.clear();
}

std::optional<std::size_t> TextHeader::column(char name) const {
  const auto found = std::find_if(columns.begin(), columns.end(),
                                  [name](const Column& column) { return column.name == name; });
  if (found == columns.end()) return std::nullopt;
  return static_cast<std::size_t>(found - columns.begin());
}

bool begins_section(std::string_view comment) {
  return is_known_key(key_of(comment)) || !columns_of(comment).empty();
}

TextHeader take_header(const Contents& contents, std::string_view& text, std::size_t first_line) {
  constexpr std::string_view kNanoscope = "\\Exported image units:";
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);  // byte order mark
  TextHeader header;
  TextKeys keys;
  const char line_end = line_end_of(text);
  while (!text.empty()) {
    std::string_view rest = text;
    const std::string_view line = trim(take_line(rest, line_end));
    if (!keys.is_nova() && starts_with_number(line)) break;
    if (!keys.is_nova() && !is_header_line(line)) {
      if (contents.bytes.find('\0') != std::string_view::npos) {
        throw Unrecognised(contents, "binary data behind a head of text", "");
      }
      throw Unrecognised(
          contents,
          fmt::format("text with '{}' on line {}", line.substr(0, 40), header.n_lines + first_line),
          "begin every line that holds no numbers with #");
    }
    if (line.starts_with(kNanoscope)) {
      header.unit = trim(line.substr(kNanoscope.size()));
      header.one_per_line = true;
    } else {
      keys.read(contents, line, header);
    }
    if (!header.is_map) read_columns(line, header);
    text = rest;
    ++header.n_lines;
  }
  keys.finish(header);
  return header;
}

}  // namespace tabor::scan::format
