#include "tabor/io/text/csv.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "tabor/core/error.hpp"
#include "tabor/core/text.hpp"
#include "tabor/io/files/atomic_file.hpp"

namespace tabor::io {
namespace {

/// True if a spreadsheet would take the cell for a formula or a command: it begins like one and is
/// no number. Such a cell gets an apostrophe, which marks text, and one more if it has any.
bool is_command(std::string_view cell) {
  const std::string_view content = cell.substr(std::min(cell.find_first_not_of('\''), cell.size()));
  constexpr std::string_view beginnings = "=+-@\t\r\n";
  return !content.empty() && beginnings.find(content.front()) != std::string_view::npos &&
         !parse_number(cell);
}

/// The cell that csv_line() wrote.
std::string without_apostrophe(std::string cell) {
  if (cell.starts_with('\'') && is_command(cell)) cell.erase(0, 1);
  return cell;
}

/// Walks through the text record by record; a quoted cell may hold newlines.
class Records {
 public:
  Records(std::string_view text, const std::string& name) : rest_(text), name_(name) {
    if (rest_.starts_with("\xEF\xBB\xBF")) {
      rest_.remove_prefix(3);  // spreadsheets put a byte order mark first
    }
  }

  bool done() const { return rest_.empty(); }
  int line() const { return line_; }

  bool skip_blank_or_comment() {
    const std::string_view next = trim(rest_.substr(0, rest_.find('\n')));
    if (!next.empty() && next.front() != '#') return false;
    take_line();
    return true;
  }

  std::vector<std::string> record() {
    std::vector<std::string> cells;
    do {
      cells.push_back(cell());
    } while (take(','));
    take('\r');
    if (!rest_.empty() && !take('\n')) {
      throw InputError(fmt::format("{}:{}: text after a closing quote", name_, line_));
    }
    ++line_;
    return cells;
  }

 private:
  bool take(char c) {
    const bool found = rest_.starts_with(c);
    rest_.remove_prefix(found ? 1 : 0);
    return found;
  }

  void take_line() {
    const auto end = rest_.find('\n');
    rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
    ++line_;
  }

  std::string cell() {
    while (rest_.starts_with(' ') || rest_.starts_with('\t')) rest_.remove_prefix(1);
    return without_apostrophe(take('"') ? quoted_cell() : plain_cell());
  }

  std::string plain_cell() {
    const std::size_t end = std::min(rest_.find_first_of(",\n"), rest_.size());
    const std::string_view content = trim(rest_.substr(0, end));
    rest_.remove_prefix(end);
    return std::string(content);
  }

  std::string quoted_cell() {
    std::string content;
    const int first_line = line_;
    while (!rest_.empty()) {
      const char c = rest_.front();
      rest_.remove_prefix(1);
      if (c == '"' && !take('"')) return content;
      line_ += c == '\n' ? 1 : 0;
      content += c;
    }
    throw InputError(fmt::format("{}:{}: a quote is never closed", name_, first_line));
  }

  std::string_view rest_;
  const std::string& name_;
  int line_ = 1;
};

}  // namespace

std::optional<std::size_t> CsvTable::find(std::string_view wanted) const {
  const auto found = std::find(columns.begin(), columns.end(), wanted);
  return found == columns.end() ? std::nullopt
                                : std::optional(static_cast<std::size_t>(found - columns.begin()));
}

std::size_t CsvTable::column(std::string_view wanted) const {
  if (const auto found = find(wanted)) return *found;
  throw InputError(fmt::format("{}: no column '{}' in the header row ({}){}", name, wanted,
                               fmt::join(columns, ", "), suggestion(wanted, columns)));
}

const std::string& CsvTable::text(std::size_t row, std::string_view wanted) const {
  return rows[row][column(wanted)];
}

double CsvTable::number(std::size_t row, std::string_view wanted) const {
  const std::string& cell = text(row, wanted);
  const auto value = parse_number(cell);
  if (!value || !std::isfinite(*value)) {
    throw InputError(fmt::format("{}:{}: column {}", name, lines[row], wanted), "'" + cell + "'",
                     "a number", "");
  }
  return *value;
}

CsvTable parse_csv(std::string_view text, const std::string& name) {
  CsvTable table;
  table.name = name;
  Records records(text, name);
  while (!records.done()) {
    if (records.skip_blank_or_comment()) continue;
    const int line = records.line();
    std::vector<std::string> cells = records.record();
    if (table.columns.empty()) {
      table.columns = std::move(cells);
      continue;
    }
    if (cells.size() != table.columns.size()) {
      throw InputError(fmt::format("{}:{}", name, line), fmt::format("{} cells", cells.size()),
                       fmt::format("{} as in the header row", table.columns.size()), "");
    }
    table.rows.push_back(std::move(cells));
    table.lines.push_back(line);
  }
  if (table.columns.empty()) throw InputError(name, "no line of text", "a header row", "");
  return table;
}

CsvTable read_csv(const std::filesystem::path& file) {
  return parse_csv(read_text(file), file.string());
}

std::string csv_line(const std::vector<std::string>& cells) {
  std::string line;
  for (const std::string& content : cells) {
    const std::string cell = is_command(content) ? "'" + content : content;
    line += &content == &cells.front() ? "" : ",";
    if (cell.find_first_of(",\"\r\n") == std::string::npos && trim(cell) == cell &&
        !cell.starts_with('#')) {
      line += cell;
      continue;
    }
    line += '"';
    for (const char c : cell) line += c == '"' ? std::string("\"\"") : std::string(1, c);
    line += '"';
  }
  return line + "\n";
}

std::string csv_number(double value) {
  return std::isfinite(value) ? fmt::format("{}", value) : "";
}

}  // namespace tabor::io
