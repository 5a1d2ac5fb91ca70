#pragma once

#include <string>
#include <vector>

#include "tabor/core/column.hpp"
#include "tabor/io/hdf5.hpp"
#include "tabor/io/json.hpp"

// Records as JSON objects, as attributes and tables of HDF5 files, and as CSV files.
namespace tabor::io {

/// Keys in the order of the cells; NaN and infinity become null.
Json json_of(const NamedCells& cells);

/// One attribute per cell.
void write_attributes(Hdf5Writer& writer, const std::string& path, const NamedCells& cells);

/// The same of a JSON object: numbers, texts, lists of texts and switches; the rest is left out.
void write_members(Hdf5Writer& writer, const std::string& path, const Json& object);

/// One column of many records as a dataset: whole numbers and switches as integers, other numbers,
/// or texts, as `kind` is.
void write_dataset(Hdf5Writer& writer, const std::string& path, const std::vector<Cell>& cells,
                   const Cell& kind);

/// A line of a CSV file; the cell of a value that does not exist is empty, a list of texts has
/// blanks between them.
std::string csv_line_of(const std::vector<Cell>& cells);

/// Values of a JSON object or of attributes; throw InputError where there is none of this kind.
Cell cell_in(const Json& object, const std::string& key);
Cell cell_in(const Hdf5Reader& reader, const std::string& path, const std::string& name,
             const Cell& kind);

template <typename Record>
Json json_of(const Columns<Record>& columns, const Record& record, Media media = kEverywhere) {
  return json_of(cells_of(columns, record, media));
}

template <typename Record>
void write_attributes(Hdf5Writer& writer, const std::string& path, const Columns<Record>& columns,
                      const Record& record, Media media = kEverywhere) {
  write_attributes(writer, path, cells_of(columns, record, media));
}

/// The value of one column in each of the records.
template <typename Record>
std::vector<Cell> cells_down(const Column<Record>& column, const std::vector<Record>& records) {
  std::vector<Cell> cells;
  cells.reserve(records.size());
  for (const Record& record : records) cells.push_back(column.value(record));
  return cells;
}

/// A dataset per column below `group`, one entry per record.
template <typename Record>
void write_datasets(Hdf5Writer& writer, const std::string& group, const Columns<Record>& columns,
                    const std::vector<Record>& records, Media media = kEverywhere) {
  for (const Column<Record>& column : columns) {
    if (!column.is_in(media)) continue;
    write_dataset(writer, group + "/" + column.key, cells_down(column, records), column.kind);
  }
}

/// The same with units and headings as `units` and `long_name`: the curves of a history.
template <typename Record>
void write_curves(Hdf5Writer& writer, const std::string& group, const Columns<Record>& columns,
                  const std::vector<Record>& records) {
  writer.group(group);
  write_datasets(writer, group, columns, records);
  for (const Column<Record>& column : columns) {
    writer.describe(group + "/" + column.key, column.unit, column.heading);
  }
}

/// A header line and a line per record.
template <typename Record>
std::string csv_of(const Columns<Record>& columns, const std::vector<Record>& records,
                   Media media = kEverywhere) {
  std::vector<Cell> cells;
  for (const Column<Record>& column : columns) {
    if (column.is_in(media)) cells.emplace_back(column.key);
  }
  std::string csv = csv_line_of(cells);
  for (const Record& record : records) {
    cells.clear();
    for (const Column<Record>& column : columns) {
      if (column.is_in(media)) cells.push_back(column.value(record));
    }
    csv += csv_line_of(cells);
  }
  return csv;
}

/// Puts what write_attributes() or json_of() wrote back into a record; throws InputError where a
/// column that can be put back is missing.
template <typename Record>
void read_attributes(const Hdf5Reader& reader, const std::string& path,
                     const Columns<Record>& columns, Record& record, Media media = kEverywhere) {
  for (const Column<Record>& column : columns) {
    if (!column.is_in(media) || !column.assign) continue;
    column.assign(record, cell_in(reader, path, column.key, column.kind));
  }
}

template <typename Record>
void read_json(const Json& object, const Columns<Record>& columns, Record& record,
               Media media = kEverywhere) {
  for (const Column<Record>& column : columns) {
    if (column.is_in(media) && column.assign) column.assign(record, cell_in(object, column.key));
  }
}

}  // namespace tabor::io
