#include "tabor/study/ehl_tables.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdint>
#include <utility>

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

/// An array per column, and the order of the columns.
void write_columns(io::Hdf5Writer& writer, const ehl::CaseColumns& columns,
                   const Results& results) {
  std::vector<std::string> keys;
  for (const ColumnHead& column : columns) keys.push_back(column.key);
  writer.attribute("/sweep", "columns", keys);
  std::vector<double> values(results.size());
  const auto write = [&](const ColumnHead& column) {
    const std::string path = "/sweep/" + column.key;
    writer.write(path, values);
    writer.describe(path, column.unit, column.heading);
    io::describe(writer, path, column);
  };
  for (const ColumnHead& column : columns) {
    for (std::size_t i = 0; i < results.size(); ++i) values[i] = results[i].number(column.key);
    write(column);
  }
  for (std::size_t i = 0; i < results.size(); ++i) values[i] = results[i].converged() ? 1 : 0;
  write({"converged", "", "converged"});
}

std::string with_unit(const SweepAxis& axis) {
  const std::string unit = axis.unit();
  return unit.empty() ? axis.key : fmt::format("{} [{}]", axis.key, unit);
}

/// A cell per axis.
std::vector<Cell> values_at(const std::vector<SweepAxis>& axes, const Places& places) {
  std::vector<Cell> cells;
  for (std::size_t a = 0; a < axes.size(); ++a) {
    cells.push_back(axes[a].has_words() ? Cell(axes[a].values[places[a]])
                                        : Cell(axes[a].numbers()[places[a]]));
  }
  return cells;
}

std::vector<results::Finding> warnings_of(const EhlSweep& sweep) {
  const std::vector<std::string> names = names_of(sweep.axes, combinations(sweep.axes));
  std::vector<results::Case> cases(sweep.results.size());
  for (std::size_t i = 0; i < cases.size(); ++i) {
    cases[i].name = names[i];
    cases[i].warnings = sweep.results[i].warnings;
  }
  return results::findings_of(cases);
}

}  // namespace

EhlSweep sweep_of(const ehl::Program& program, std::vector<SweepAxis> axes, Results results) {
  const ehl::CaseStudy* study = study_of(program, axes);
  EhlSweep sweep{.program = program,
                 .axes = std::move(axes),
                 .results = std::move(results),
                 .columns = {},
                 .warnings = {},
                 .limits = {}};
  sweep.columns = columns_of(program, sweep.results);
  sweep.warnings = warnings_of(sweep);
  if (study) {
    sweep.limits = limits_of(sweep.columns, *study, sweep.axes.front().numbers(), sweep.results);
  }
  return sweep;
}

std::string csv_of(const EhlSweep& sweep) {
  std::vector<Cell> cells;
  for (const SweepAxis& axis : sweep.axes) cells.emplace_back(with_unit(axis));
  for (const ColumnHead& column : sweep.columns) cells.emplace_back(column.key);
  cells.emplace_back("converged");
  cells.emplace_back("warnings");
  cells.emplace_back("warning_codes");
  std::string csv = io::csv_line_of(cells);
  const std::vector<Places> all = combinations(sweep.axes);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const ehl::CaseResult& result = sweep.results[i];
    cells = values_at(sweep.axes, all[i]);
    for (const ColumnHead& column : sweep.columns) cells.emplace_back(result.number(column.key));
    cells.emplace_back(result.converged());
    cells.emplace_back(fmt::format("{}", fmt::join(texts_of(result.warnings), "; ")));
    cells.emplace_back(results::codes_text(result.warnings));
    csv += io::csv_line_of(cells);
  }
  return csv;
}

void write_sweep(const std::filesystem::path& file, const results::ResultHead& head,
                 const EhlSweep& sweep, const std::vector<results::Finding>& warnings) {
  io::Hdf5Writer writer(file);
  results::write_result_head(writer, head);
  writer.attribute("/", "kind", "ehl " + sweep.program.name + " sweep");
  write_axes(writer, sweep.axes);
  write_columns(writer, sweep.columns, sweep.results);
  std::vector<std::string> texts, codes;
  for (const ehl::CaseResult& result : sweep.results) {
    texts.push_back(fmt::format("{}", fmt::join(texts_of(result.warnings), "\n")));
    codes.push_back(results::codes_text(result.warnings));
  }
  writer.write("/sweep/warnings", texts);
  writer.write("/sweep/warning_codes", codes);
  results::write_warnings(writer, warnings);
  writer.commit();
}

}  // namespace tabor::study
