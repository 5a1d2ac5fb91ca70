#include "tabor/cli/csv_output.hpp"

#include "tabor/io/files/atomic_file.hpp"

namespace tabor::cli {

namespace {

constexpr const char* kTerminal = "-";

}  // namespace

bool CsvRequest::prints() const { return file == kTerminal; }

void declare_csv(OptionSet& set, const std::string& what, CsvRequest& request) {
  Option& option = set.text(
      "--csv", "[FILE.csv]",
      "write CSV in SI units, " + what + "; without FILE.csv it is printed instead of the table",
      request.file);
  option.names = FileRole::output;
  option.extensions = {".csv"};
  option.if_bare = kTerminal;
}

std::string write_csv(const CsvRequest& request, const std::string& csv, const std::string& text) {
  if (request.prints()) return csv;
  if (request.file) io::write_file(*request.file, csv);
  return text;
}

}  // namespace tabor::cli
