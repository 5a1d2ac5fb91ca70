#pragma once

#include <string>

#include "values.hpp"

// Records as state of a pickle: numbers by the names of their columns.
namespace tabor::python {

/// A value as the kind of its column.
Cell cell_of(nb::handle value, const Cell& kind);

/// All that can be put back.
template <typename Record>
nb::dict saved(const Columns<Record>& columns, const Record& record) {
  NamedCells cells;
  for (const Column<Record>& column : columns) {
    if (column.assign && !column.key.empty()) cells.push_back({column, column.value(record)});
  }
  return dict_of(cells);
}

/// Puts it back.
template <typename Record>
void restore(const Columns<Record>& columns, const nb::dict& numbers, Record& record) {
  for (const Column<Record>& column : columns) {
    if (!column.assign || column.key.empty()) continue;
    column.assign(record, cell_of(numbers[column.key.c_str()], column.kind));
  }
}

}  // namespace tabor::python
