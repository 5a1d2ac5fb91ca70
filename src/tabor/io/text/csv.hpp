#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

// Reads and writes CSV tables.
namespace tabor::io {

/// Table of text cells under one header row (RFC 4180: comma, double quotes, "" inside quotes).
struct CsvTable {
  std::string name;  ///< of the file, for messages
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;  ///< each as long as `columns`
  std::vector<int> lines;                      ///< line of the file each row starts on, from 1

  std::optional<std::size_t> find(std::string_view column) const;
  /// Returns the place of a column. Throws InputError naming the nearest column.
  std::size_t column(std::string_view column) const;
  const std::string& text(std::size_t row, std::string_view column) const;
  /// Returns a finite number. Throws InputError with file, line and column otherwise.
  double number(std::size_t row, std::string_view column) const;
};

/// Read a table; blank lines and lines that start with '#' are skipped. Throw InputError (file,
/// line, reason).
CsvTable read_csv(const std::filesystem::path& file);
CsvTable parse_csv(std::string_view text, const std::string& name);

/// Returns one line with its newline; cells are quoted where they must be. Text that begins with
/// one of = + - @ is prefixed with an apostrophe, which parse_csv() removes: a spreadsheet would
/// read it as a formula.
std::string csv_line(const std::vector<std::string>& cells);

/// Returns the shortest text that reads back to the same number; "" for NaN and infinity (no
/// value).
std::string csv_number(double value);

}  // namespace tabor::io
