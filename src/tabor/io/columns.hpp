#pragma once

#include <cmath>
#include <string>
#include <variant>
#include <vector>

#include "tabor/core/column.hpp"
#include "tabor/io/hdf5/hdf5.hpp"
#include "tabor/io/text/json.hpp"

// Converts records to JSON objects, to attributes and tables of HDF5 files, and to CSV files, and
// reads them back.
namespace tabor::io {

/// Returns an object with keys in the order of the cells; NaN and infinity become null.
Json json_of(const NamedCells& cells);

/// Writes one attribute per cell.
void write_attributes(Hdf5Writer& writer, const std::string& path, const NamedCells& cells);

/// Writes one attribute per member of a JSON object: numbers, texts, lists of texts and switches;
/// the rest is left out.
void write_members(Hdf5Writer& writer, const std::string& path, const Json& object);

/// Writes one column of many records as a dataset of the type of `kind`: whole numbers and switches
/// as integers, other numbers, or texts.
void write_dataset(Hdf5Writer& writer, const std::string& path, const std::vector<Cell>& cells,
                   const Cell& kind);

/// Writes what is known of a column as attributes of its dataset: `units`, `heading` and `style`
/// (core/column.hpp); what it does not have is left out.
void describe(Hdf5Writer& writer, const std::string& path, const ColumnHead& head);

/// Writes the same of numbers that stand as attributes: the texts `key`, `heading`, `units` and
/// `style` below /columns, each key once.
void write_column_table(Hdf5Writer& writer, const std::vector<ColumnHead>& heads);

/// Returns a line of a CSV file; the cell of a value that does not exist is empty, a list of texts
/// has blanks between them.
std::string csv_line_of(const std::vector<Cell>& cells);

/// Return values of a JSON object or of attributes; throw InputError where there is none of this
/// kind.
Cell cell_in(const Json& object, const std::string& key);
bool has_cell(const Json& object, const std::string& key);
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

/// Returns the value of one column in each of the records.
template <typename Record>
std::vector<Cell> cells_down(const Column<Record>& column, const std::vector<Record>& records) {
  std::vector<Cell> cells;
  cells.reserve(records.size());
  for (const Record& record : records) cells.push_back(column.value(record));
  return cells;
}

/// Writes a dataset per column below `group`, one entry per record, and describes it.
template <typename Record>
void write_datasets(Hdf5Writer& writer, const std::string& group, const Columns<Record>& columns,
                    const std::vector<Record>& records, Media media = kEverywhere) {
  for (const Column<Record>& column : columns) {
    if (!column.is_in(media)) continue;
    const std::string path = group + "/" + column.key;
    write_dataset(writer, path, cells_down(column, records), column.kind);
    describe(writer, path, column);
  }
}

/// Writes the curves of a history: such datasets with their headings as `long_name`, too.
template <typename Record>
void write_curves(Hdf5Writer& writer, const std::string& group, const Columns<Record>& columns,
                  const std::vector<Record>& records) {
  writer.group(group);
  write_datasets(writer, group, columns, records);
  for (const Column<Record>& column : columns) {
    writer.describe(group + "/" + column.key, column.unit, column.heading);
  }
}

/// Returns a header line and a line per record.
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

/// True where the cells of this kind are numbers that may be unknown.
inline bool is_number(const Cell& kind) { return std::holds_alternative<double>(kind); }

/// Reads into a record what write_attributes() or json_of() wrote. A number that the file lacks, as
/// a file of an older version may, is NaN; a missing text, count or switch is an InputError.
template <typename Record>
void read_attributes(const Hdf5Reader& reader, const std::string& path,
                     const Columns<Record>& columns, Record& record, Media media = kEverywhere) {
  for (const Column<Record>& column : columns) {
    if (!column.is_in(media) || !column.assign) continue;
    const bool is_lacking = is_number(column.kind) && !reader.has_attribute(path, column.key);
    column.assign(record,
                  is_lacking ? Cell(std::nan("")) : cell_in(reader, path, column.key, column.kind));
  }
}

template <typename Record>
void read_json(const Json& object, const Columns<Record>& columns, Record& record,
               Media media = kEverywhere) {
  for (const Column<Record>& column : columns) {
    if (!column.is_in(media) || !column.assign) continue;
    const bool is_lacking = is_number(column.kind) && !has_cell(object, column.key);
    column.assign(record, is_lacking ? Cell(std::nan("")) : cell_in(object, column.key));
  }
}

}  // namespace tabor::io
