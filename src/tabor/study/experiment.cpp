#include "tabor/study/experiment.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "tabor/core/error.hpp"
#include "tabor/core/units.hpp"
#include "tabor/io/text/csv.hpp"

namespace tabor::study {
namespace {

/// A column whose header may name the unit of its numbers.
struct UnitColumn {
  std::string name;
  Dimension dimension;
  std::vector<std::pair<std::string, double>> suffixes;  ///< {"_MPa", 1e6}
};

const UnitColumn kPressure{
    "mean_pressure", dimension::pressure, {{"_Pa", 1}, {"_kPa", 1e3}, {"_MPa", 1e6}}};
const UnitColumn kDensity{
    "lubricant_density", dimension::areal_density, {{"_g_per_m2", 1e-3}, {"_kg_per_m2", 1}}};

/// Reads one row of the column; NaN if the table has no such column.
double value_of(const io::CsvTable& table, std::size_t row, const UnitColumn& column) {
  if (table.find(column.name)) {
    return parse_si(table.text(row, column.name), column.dimension,
                    fmt::format("{}:{}: {}", table.name, table.lines[row], column.name));
  }
  for (const auto& [suffix, factor] : column.suffixes) {
    if (table.find(column.name + suffix)) return factor * table.number(row, column.name + suffix);
  }
  return std::numeric_limits<double>::quiet_NaN();
}

void check(const io::CsvTable& table) {
  std::vector<std::string> known{"friction", "error", "group"};
  for (const UnitColumn* column : {&kPressure, &kDensity}) {
    known.push_back(column->name);
    for (const auto& [suffix, factor] : column->suffixes) known.push_back(column->name + suffix);
  }
  for (const std::string& column : table.columns) {
    if (std::find(known.begin(), known.end(), column) == known.end()) {
      throw InputError(fmt::format("{}: unknown column '{}'; known are {}", table.name, column,
                                   fmt::join(known, ", ")));
    }
  }
  table.column("friction");
}

}  // namespace

Experiment read_experiment(const std::filesystem::path& file) {
  const io::CsvTable table = io::read_csv(file);
  check(table);
  Experiment experiment;
  experiment.file = file;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    const double pressure = value_of(table, row, kPressure);
    if (!(pressure > 0)) {
      throw InputError(fmt::format("{}:{}", table.name, table.lines[row]), "no mean pressure > 0",
                       "a column mean_pressure_Pa, or mean_pressure with units", "");
    }
    experiment.mean_pressure.push_back(pressure);
    experiment.friction.push_back(table.number(row, "friction"));
    experiment.error.push_back(table.find("error") ? table.number(row, "error")
                                                   : std::numeric_limits<double>::quiet_NaN());
    experiment.lubricant_density.push_back(value_of(table, row, kDensity));
  }
  return experiment;
}

}  // namespace tabor::study
