#include "tabor/study/ehl_tables.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdint>

#include "tabor/io/columns.hpp"
#include "tabor/study/ehl_sweep.hpp"

namespace tabor::study {

using Results = std::vector<ehl::CaseResult>;

namespace {

/// The axes, in their order: the last one is the fastest.
void write_axes(io::Hdf5Writer& writer, const std::vector<SweepAxis>& axes) {
  writer.group("/sweep/axes");
  std::vector<std::string> keys;
  std::vector<std::int64_t> shape;
  for (const SweepAxis& axis : axes) {
    const std::string path = "/sweep/axes/" + axis.key;
    keys.push_back(axis.key);
    shape.push_back(static_cast<std::int64_t>(axis.values.size()));
    writer.write(path, axis.numbers());
    writer.describe(path, axis.unit(), axis.key);
    if (axis.has_words()) writer.attribute(path, "words", axis.values);
  }
  writer.attribute("/sweep", "axes", keys);
  writer.write("/sweep/shape", shape);
}

/// An array per column.
void write_columns(io::Hdf5Writer& writer, const std::vector<ehl::CaseColumn>& columns,
                   const Results& results) {
  std::vector<double> values(results.size());
  const auto write = [&](const std::string& name, const std::string& unit,
                         const std::string& heading) {
    writer.write("/sweep/" + name, values);
    writer.describe("/sweep/" + name, unit, heading);
  };
  for (const ehl::CaseColumn& column : columns) {
    for (std::size_t i = 0; i < results.size(); ++i) {
      values[i] = number_of(results[i].scalars, column.key);
    }
    write(column.key, column.unit, column.heading);
  }
  for (std::size_t i = 0; i < results.size(); ++i) values[i] = results[i].converged ? 1 : 0;
  write("converged", "", "converged");
}

}  // namespace

std::string with_unit(const std::string& key, const std::string& unit) {
  return unit.empty() ? key : fmt::format("{} [{}]", key, unit);
}

EhlRows rows_of(const std::vector<SweepAxis>& axes) {
  EhlRows rows;
  for (const SweepAxis& axis : axes) rows.keys.push_back(with_unit(axis.key, axis.unit()));
  for (const Places& places : combinations(axes)) {
    std::vector<Cell>& cells = rows.values.emplace_back();
    for (std::size_t a = 0; a < axes.size(); ++a) {
      const bool is_word = axes[a].has_words();
      cells.push_back(is_word ? Cell(axes[a].values[places[a]])
                              : Cell(axes[a].numbers()[places[a]]));
    }
  }
  return rows;
}

std::string csv_of(const ehl::Program& program, const EhlRows& rows, const Results& results) {
  const std::vector<ehl::CaseColumn> columns = columns_of(program, results);
  std::vector<Cell> cells(rows.keys.begin(), rows.keys.end());
  for (const ehl::CaseColumn& column : columns) cells.emplace_back(column.key);
  cells.emplace_back("converged");
  cells.emplace_back("warnings");
  std::string csv = io::csv_line_of(cells);
  for (std::size_t i = 0; i < results.size(); ++i) {
    cells = rows.values[i];
    for (const ehl::CaseColumn& column : columns) {
      cells.emplace_back(number_of(results[i].scalars, column.key));
    }
    cells.emplace_back(results[i].converged);
    cells.emplace_back(fmt::format("{}", fmt::join(results[i].warnings, "; ")));
    csv += io::csv_line_of(cells);
  }
  return csv;
}

void write_sweep(const std::filesystem::path& file, const analysis::ResultHead& head,
                 const EhlSweep& sweep, const std::vector<analysis::Finding>& warnings) {
  io::Hdf5Writer writer(file);
  analysis::write_result_head(writer, head);
  writer.attribute("/", "kind", "ehl " + sweep.program.name + " sweep");
  write_axes(writer, sweep.axes);
  write_columns(writer, columns_of(sweep.program, sweep.results), sweep.results);
  std::vector<std::string> of_cases;
  of_cases.reserve(sweep.results.size());
  for (const ehl::CaseResult& result : sweep.results) {
    of_cases.push_back(fmt::format("{}", fmt::join(result.warnings, "\n")));
  }
  writer.write("/sweep/warnings", of_cases);
  writer.write("/sweep/warning_marks", sweep.marks);
  analysis::write_warnings(writer, warnings);
  writer.commit();
}

}  // namespace tabor::study
