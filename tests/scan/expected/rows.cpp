#include "rows.hpp"

#include <cmath>
#include <cstdlib>
#include <set>

#include "support/scans.hpp"
#include "tabor/core/units.hpp"
#include "tabor/io/text/csv.hpp"

namespace tabor::scan::test {

double half_digit(const std::string& printed) {
  const std::string digits = printed.substr(0, printed.find_first_of("eE"));
  const std::size_t point = digits.find('.');
  const auto decimals = point == std::string::npos ? 0 : digits.size() - point - 1;
  const double mantissa = std::abs(std::strtod(digits.c_str(), nullptr));
  return mantissa > 0 ? 0.5 * std::pow(10.0, -static_cast<double>(decimals)) / mantissa : 0;
}

namespace {

/// "um or % or 1" does not say which: these quantities are plain numbers or per cent.
bool is_pure_number(const std::string& quantity) {
  static const std::set<std::string> pure{"Ssk",
                                          "Sku",
                                          "Sdr",
                                          "Sdq",
                                          "Str",
                                          "Rsk",
                                          "Rku",
                                          "Rdq",
                                          "Mr1",
                                          "Mr2",
                                          "Smr1",
                                          "Smr2",
                                          "surface_area/projected"};
  return pure.contains(quantity);
}

double factor_of(const std::string& unit, const std::string& quantity) {
  if (unit.starts_with("um or ")) return is_pure_number(quantity) ? 1 : 1e-6;
  if (unit == "px" || unit == "1" || unit == "%") return 1;
  return unit_factor(unit, dimension::length).value();
}

Row row_of(const io::CsvTable& table, std::size_t i) {
  Row row;
  row.file = table.text(i, "file");
  row.quantity = table.text(i, "quantity");
  row.convention = table.text(i, "convention");
  row.provenance = table.text(i, "provenance");
  row.unit = table.text(i, "unit");
  row.text = table.text(i, "value");
  row.factor = factor_of(row.unit, row.quantity);
  row.value = std::strtod(row.text.c_str(), nullptr) * row.factor;
  row.recomputed = table.text(i, "recomputed_here");
  const std::string& noted = table.text(i, "rel_diff");
  const double difference = std::abs(std::strtod(noted.c_str(), nullptr));
  if (difference > 0) row.noted_difference = difference * (1 + half_digit(noted));
  return row;
}

}  // namespace

std::vector<Row> expected_rows() {
  const io::CsvTable table = io::read_csv(tabor::test::shared_scan("expected.csv"));
  std::vector<Row> rows;
  for (std::size_t i = 0; i < table.rows.size(); ++i) rows.push_back(row_of(table, i));
  return rows;
}

}  // namespace tabor::scan::test
