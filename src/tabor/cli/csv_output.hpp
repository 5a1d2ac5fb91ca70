#pragma once

#include <optional>
#include <string>

#include "tabor/cli/options.hpp"

// Declares the option `--csv [FILE.csv]` of a verb and writes its table to the file or the
// terminal.
namespace tabor::cli {

/// Destination of the CSV table of a verb, if any.
struct CsvRequest {
  std::optional<std::string> file;  ///< "-": the terminal

  bool is_asked() const { return file.has_value(); }
  bool prints() const;
};

/// Declares `--csv [FILE.csv]`; `what` says what the file holds: "one row per state".
void declare_csv(OptionSet& set, const std::string& what, CsvRequest& request);

/// Writes the file that is asked for. Returns what to print: the CSV if it goes to the terminal,
/// else `text`.
std::string write_csv(const CsvRequest& request, const std::string& csv, const std::string& text);

}  // namespace tabor::cli
