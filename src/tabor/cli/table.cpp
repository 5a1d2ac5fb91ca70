#include "tabor/cli/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "tabor/cli/layout.hpp"
#include "tabor/core/printable.hpp"
#include "tabor/core/units.hpp"

namespace tabor::cli {

namespace {

bool is_numeric(const std::string& cell) {
  return !cell.empty() && (std::isdigit(static_cast<unsigned char>(cell.front())) ||
                           cell.front() == '-' || cell.front() == '.');
}

std::string aligned(const std::string& cell, std::size_t column_width, bool right) {
  const std::string blanks(column_width - std::min(column_width, width_on_screen(cell)), ' ');
  return right ? blanks + cell : cell + blanks;
}

std::string without_trailing_blanks(std::string line) {
  line.erase(line.find_last_not_of(' ') + 1);
  return line + '\n';
}

std::string count_text(const Cell& cell) {
  return std::holds_alternative<std::monostate>(cell) ? "-" : fmt::format("{}", integer_in(cell));
}

std::string number_text(double value, const ColumnHead& head) {
  switch (head.style.shown) {
    case Shown::percent:
      return percent(value);
    case Shown::exponent:
      return std::isnan(value) ? "-" : fmt::format("{:.1e}", value);
    case Shown::unscaled:
      return plain(value) + " " + head.unit;
    default:
      return head.unit.empty() ? plain(value) : si(value, head.unit);
  }
}

}  // namespace

void Table::row(std::vector<std::string> cells) {
  cells.resize(headings_.size());
  for (std::string& cell : cells) cell = printable(cell);
  rows_.push_back(std::move(cells));
}

std::string Table::text() const {
  std::vector<std::size_t> widths;
  std::vector<bool> right;
  for (std::size_t column = 0; column < headings_.size(); ++column) {
    std::size_t column_width = width_on_screen(headings_[column]);
    bool numeric = !rows_.empty();
    for (const auto& cells : rows_) {
      column_width = std::max(column_width, width_on_screen(cells[column]));
      numeric = numeric && is_numeric(cells[column]);
    }
    widths.push_back(column_width);
    right.push_back(numeric);
  }
  const auto line = [&](const std::vector<std::string>& cells) {
    std::string joined;
    for (std::size_t column = 0; column < cells.size(); ++column) {
      joined += (column > 0 ? "  " : "") + aligned(cells[column], widths[column], right[column]);
    }
    return without_trailing_blanks(joined);
  };
  std::vector<std::string> rules;
  for (const std::size_t column_width : widths) rules.emplace_back(column_width, '-');
  std::string text = line(headings_) + line(rules);
  for (const auto& cells : rows_) text += line(cells);
  return text;
}

void Facts::fact(const std::string& label, const std::string& value) {
  if (!value.empty()) lines_.emplace_back(printable(label), printable(value));
}

std::string Facts::text() const {
  std::size_t column_width = 0;
  for (const auto& [label, value] : lines_) {
    column_width = std::max(column_width, width_on_screen(label));
  }
  std::string text;
  for (const auto& [label, value] : lines_) {
    text += aligned(label, column_width, false) + "  " + value + '\n';
  }
  return text;
}

std::string text_of(const Cell& cell, const ColumnHead& head) {
  if (const auto* text = std::get_if<std::string>(&cell)) return *text;
  if (const auto* is_on = std::get_if<bool>(&cell)) {
    return head.style.shown == Shown::alarm ? (*is_on ? "YES" : "no") : yes_no(*is_on);
  }
  if (!std::holds_alternative<double>(cell) && head.unit.empty()) return count_text(cell);
  return number_text(number_in(cell), head);
}

}  // namespace tabor::cli
