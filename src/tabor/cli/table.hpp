#pragma once

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "tabor/core/column.hpp"
#include "tabor/core/text.hpp"
#include "tabor/core/units.hpp"

// Lays out results for the terminal: tables of records, and lines of label and value.
namespace tabor::cli {

/// Rows of text under headings, aligned for a fixed-width screen: numbers right, words left.
class Table {
 public:
  explicit Table(std::vector<std::string> headings) : headings_(std::move(headings)) {}
  void row(std::vector<std::string> cells);
  std::string text() const;

 private:
  std::vector<std::string> headings_;
  std::vector<std::vector<std::string>> rows_;
};

/// Aligned lines "label   value"; lines with an empty value are left out.
class Facts {
 public:
  void fact(const std::string& label, const std::string& value);
  std::string text() const;

 private:
  std::vector<std::pair<std::string, std::string>> lines_;
};

/// Returns the text of one value, in the style of its column.
std::string text_of(const Cell& cell, const ColumnHead& head);

/// Makes a table of the columns that have a heading and a value in at least one record.
template <typename Record>
Table table_of(const Columns<Record>& columns, const std::vector<Record>& records) {
  Columns<Record> shown;
  std::vector<std::string> headings;
  for (const Column<Record>& column : columns) {
    const bool is_there = std::any_of(records.begin(), records.end(), [&](const Record& record) {
      return !std::holds_alternative<std::monostate>(column.value(record));
    });
    if (column.heading.empty() || !is_there) continue;
    shown.push_back(column);
    headings.push_back(column.heading);
  }
  Table table(headings);
  for (const Record& record : records) {
    std::vector<std::string> cells;
    for (const Column<Record>& column : shown) {
      cells.push_back(text_of(column.value(record), column));
    }
    table.row(cells);
  }
  return table;
}

}  // namespace tabor::cli
