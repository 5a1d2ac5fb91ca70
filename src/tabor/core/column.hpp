#pragma once

#include <cmath>
#include <concepts>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

// Defines the columns of a record: the name, unit and outputs of each of its numbers, said once.
// JSON objects, attributes and tables of HDF5 files, CSV files and the tables on the terminal are
// all made from them (io/columns.hpp, cli/table.hpp).
namespace tabor {

/// One value of a record. std::monostate: the record has no such value, and it is left out; a NaN
/// is a value that could not be found, which becomes null or an empty cell.
using Cell = std::variant<std::monostate, double, std::int64_t, std::uint64_t, bool, std::string,
                          std::vector<std::string>>;

/// Style of a value on the terminal.
enum class Shown {
  by_unit,   ///< with an SI prefix, "7 MPa"; a number without a unit plainly, a switch as yes or NO
  unscaled,  ///< its unit without a prefix, "0.45 g/m²"
  percent,   ///< a share of one
  exponent,  ///< "2.1e-07"
  alarm      ///< a switch that should be off, as no or YES
};
std::string_view name_of(Shown style);  ///< "by_unit", ...

/// Outputs in which a column appears, as bits. A table of columns may serve several outputs that do
/// not all hold the same numbers; the meaning of the bits stands beside the columns of a record.
using Media = unsigned;
inline constexpr Media kEverywhere = ~0U;

/// Style and outputs of a column.
struct ColumnStyle {
  Shown shown = Shown::by_unit;
  Media media = kEverywhere;
};

/// Column without its value.
struct ColumnHead {
  std::string key;   ///< "mean_gap_m", in every output; a dot leads into an object: "wear.time_s".
                     ///< Empty: on the terminal only
  std::string unit;  ///< "m"; empty for a plain number or a text
  std::string
      heading;  ///< "mean gap", on the terminal and as long_name; empty: not on the terminal
  ColumnStyle style = {};

  /// True where one of these outputs has the column.
  bool is_in(Media media) const { return !key.empty() && (style.media & media) != 0; }
};

/// Returns access to a member of a member: member_of(&Record::convergence,
/// &Convergence::iterations).
template <typename Record, typename Part, typename Value>
auto member_of(Part Record::*part, Value Part::*member) {
  return [part, member](auto& record) -> decltype(auto) { return ((record.*part).*member); };
}

namespace detail {

template <typename Value>
Cell to_cell(const Value& value) {
  if constexpr (std::is_same_v<Value, bool> || std::is_same_v<Value, Cell>) {
    return value;
  } else if constexpr (std::is_floating_point_v<Value>) {
    return static_cast<double>(value);
  } else if constexpr (std::is_integral_v<Value> && std::is_unsigned_v<Value>) {
    return static_cast<std::uint64_t>(value);
  } else if constexpr (std::is_integral_v<Value>) {
    return static_cast<std::int64_t>(value);
  } else if constexpr (std::is_convertible_v<Value, std::vector<std::string>>) {
    return std::vector<std::string>(value);
  } else {
    return std::string(value);
  }
}

template <typename Value>
Cell to_cell(const std::optional<Value>& value) {
  return value ? to_cell(*value) : Cell(std::nan(""));
}

}  // namespace detail

/// Returns the number of a cell, 0 or 1 for a switch; NaN for a text or no value.
double number_in(const Cell& cell);

/// Puts the value of a cell into a variable; throws InputError if it is of another kind.
void assign(const Cell& cell, double& target);
void assign(const Cell& cell, std::optional<double>& target);  ///< NaN is no value
void assign(const Cell& cell, bool& target);
void assign(const Cell& cell, std::string& target);
void assign(const Cell& cell, std::vector<std::string>& target);
std::int64_t integer_in(const Cell& cell);
template <typename Integer>
requires std::is_integral_v<Integer>
void assign(const Cell& cell, Integer& target) { target = static_cast<Integer>(integer_in(cell)); }

/// One number of a record: its name, and how it is read from a record and written into one.
template <typename Record>
struct Column : ColumnHead {
  std::function<Cell(const Record&)> value;
  std::function<void(Record&, const Cell&)> assign;  ///< empty for computed values
  Cell kind;                                         ///< any value of the kind that it has

  /// `access`: a member pointer or member_of(), which can be read back, or
  /// any function of the record, which cannot.
  template <typename Access>
  Column(std::string named, std::string in_unit, std::string above, Access access,
         ColumnStyle styled = {})
      : ColumnHead{std::move(named), std::move(in_unit), std::move(above), styled},
        value([access](const Record& record) {
          return detail::to_cell(std::invoke(access, record));
        }),
        kind(detail::to_cell(std::decay_t<std::invoke_result_t<Access, const Record&>>{})) {
    if constexpr (std::is_invocable_v<Access, Record&>) {
      using Result = std::invoke_result_t<Access, Record&>;
      if constexpr (std::is_lvalue_reference_v<Result> &&
                    !std::is_const_v<std::remove_reference_t<Result>>) {
        assign = [access](Record& record, const Cell& cell) {
          tabor::assign(cell, std::invoke(access, record));
        };
      }
    }
  }

  /// Takes the same number from a record that `part` finds in this one (null: there is none).
  /// `made` finds it, or makes it, where the record is to be filled.
  template <typename Part, typename Find, typename Make>
  Column(const Column<Part>& column, Find part, Make made)
      : ColumnHead(column),
        value([column, part](const Record& record) {
          const Part* found = part(record);
          return found != nullptr ? column.value(*found) : Cell();
        }),
        kind(column.kind) {
    if (!column.assign) return;
    assign = [column, made](Record& record, const Cell& cell) {
      column.assign(made(record), cell);
    };
  }
};

/// The columns of a record, in their order.
template <typename Record>
using Columns = std::vector<Column<Record>>;

/// Returns the columns of a record that is a part of another one.
template <typename Record, typename Part>
Columns<Record> within(const Columns<Part>& columns, Part Record::*part) {
  Columns<Record> all;
  for (const Column<Part>& column : columns) {
    all.emplace_back(
        column, [part](const Record& record) { return &(record.*part); },
        [part](Record& record) -> Part& { return record.*part; });
  }
  return all;
}

/// Returns the columns of a part that a record may lack; they have no values where it does.
template <typename Record, typename Part>
Columns<Record> within(const Columns<Part>& columns, std::optional<Part> Record::*part) {
  Columns<Record> all;
  for (const Column<Part>& column : columns) {
    all.emplace_back(
        column, [part](const Record& record) { return record.*part ? &*(record.*part) : nullptr; },
        [part](Record& record) -> Part& {
          return record.*part ? *(record.*part) : (record.*part).emplace();
        });
  }
  return all;
}

/// Returns the columns of a record that this one is derived from.
template <typename Record, typename Base>
Columns<Record> inherited(const Columns<Base>& columns) {
  Columns<Record> all;
  for (const Column<Base>& column : columns) {
    all.emplace_back(
        column, [](const Record& record) -> const Base* { return &record; },
        [](Record& record) -> Base& { return record; });
  }
  return all;
}

/// Returns the columns of all lists, one after the other.
template <typename Record, std::same_as<Columns<Record>>... More>
Columns<Record> joined(Columns<Record> first, const Columns<Record>& second, const More&... more) {
  first.insert(first.end(), second.begin(), second.end());
  (first.insert(first.end(), more.begin(), more.end()), ...);
  return first;
}

/// The same columns in an object of this name: "max_force_N" becomes "dry.max_force_N".
template <typename Record>
Columns<Record> below(const std::string& object, Columns<Record> columns) {
  for (Column<Record>& column : columns) column.key = object + "." + column.key;
  return columns;
}

/// One line of a table: columns with the values of one record.
struct NamedCell {
  ColumnHead head;
  Cell cell;
};
/// The values of one record.
using NamedCells = std::vector<NamedCell>;

/// Returns the values of a record for some of the outputs, in the order of its columns; values that
/// the record does not have are left out.
template <typename Record>
NamedCells cells_of(const Columns<Record>& columns, const Record& record,
                    Media media = kEverywhere) {
  NamedCells cells;
  for (const Column<Record>& column : columns) {
    if (!column.is_in(media)) continue;
    Cell cell = column.value(record);
    if (!std::holds_alternative<std::monostate>(cell)) cells.push_back({column, std::move(cell)});
  }
  return cells;
}

}  // namespace tabor
