#pragma once

#include <string_view>
#include <vector>

#include "tabor/scan/formats/format.hpp"

// Parses the numbers of a text file on all threads.
namespace tabor::scan::format {

/// Consecutive lines with equally many numbers.
struct TextRows {
  std::size_t first_line = 0;  ///< its number in the file, from 1
  std::size_t n_rows = 0;
  std::size_t n_columns = 0;
};

/// Numbers of a text file, line after line; lines without any do not count.
struct TextNumbers {
  std::vector<double> values;  ///< NaN = hole (NaN, NM, BAD, an empty field, ...)
  std::vector<TextRows> rows;
  std::string_view rest = {};  ///< of the text: from the line on that begins another section
  std::size_t rest_line = 0;   ///< that line's number in the file

  std::size_t n_rows() const;
  std::size_t n_columns() const { return rows.empty() ? 0 : rows.front().n_columns; }
  /// Returns the first lines with another count of numbers than the first one; null if there are
  /// none.
  const TextRows* odd_rows() const;
};

/// Facts of a text's header about its numbers.
struct TextHints {
  std::size_t first_line = 1;  ///< their first line's number in the file
  bool one_per_line = false;   ///< each line is one number
  bool two_columns = false;    ///< each line is two
  bool (*begins_section)(std::string_view comment) = nullptr;  ///< a comment that ends the numbers
};

/// True if the line starts with a number or with a word for a missing value.
bool starts_with_number(std::string_view line);

/// Returns the end of the lines of a text: '\n', or '\r' as old Macintosh programs write.
char line_end_of(std::string_view text);

/// Removes the first line from `text` and returns it without its end.
std::string_view take_line(std::string_view& text, char line_end = '\n');

/// Parses all of `text` on all threads. Fields are separated by blanks, tabs, ';' or ','; where ','
/// must be a decimal comma it is one. Lines that begin with # or // are left out. Parsed pages of
/// the file are released. Throws InputError with the line of the first field that is no number, of
/// an empty cell between tabs, or of commas that may be both; Interrupted.
TextNumbers parse_numbers(const Contents& contents, std::string_view text, const TextHints& hints);

/// Returns the text of a table whose cells stand in quotation marks, without the marks and with
/// decimal points for decimal commas inside; nullopt if the text does not start with such cells.
/// Other cells with a comma keep their marks, so that they are no numbers.
std::optional<std::string> without_quotes(std::string_view text);

/// Returns the UTF-8 of a text that begins with the byte order mark of UTF-16; nullopt for every
/// other.
std::optional<std::string> utf8_from_utf16(std::string_view text);

}  // namespace tabor::scan::format
