#pragma once

#include <string>
#include <vector>

namespace tabor::scan::test {

/// One line of expected.csv: a published or independently computed number.
struct Row {
  std::string file, quantity, convention, provenance, unit;
  std::string text;             ///< the number as printed
  double factor = 1;            ///< from the printed unit to SI; percent stays percent
  double value = 0;             ///< in SI
  std::string recomputed;       ///< the list's own value as printed, "" if there is none
  double noted_difference = 0;  ///< relative, of that own value and the published one, rounded up

  std::string name() const { return file + ": " + quantity + " (" + convention + ")"; }
};

/// Half a unit of the last digit of a printed number, relative to it.
double half_digit(const std::string& printed);

/// All lines in their order. Reads expected.csv beside the measured scans, which must be there.
std::vector<Row> expected_rows();

}  // namespace tabor::scan::test
