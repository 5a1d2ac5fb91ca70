#pragma once

#include <string>
#include <utility>
#include <variant>

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
    if (!column.assign || column.key.empty()) continue;
    Cell cell = column.value(record);
    const bool is_of_absent_part = std::holds_alternative<std::monostate>(cell);
    if (!is_of_absent_part) cells.push_back({column, std::move(cell)});
  }
  return dict_of(cells);
}

/// Puts it back.
template <typename Record>
void restore(const Columns<Record>& columns, const nb::dict& numbers, Record& record) {
  for (const Column<Record>& column : columns) {
    if (!column.assign || !numbers.contains(column.key.c_str())) continue;
    column.assign(record, cell_of(numbers[column.key.c_str()], column.kind));
  }
}

}  // namespace tabor::python
