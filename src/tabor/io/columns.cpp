#include "tabor/io/columns.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "tabor/core/error.hpp"
#include "tabor/core/text.hpp"
#include "tabor/io/text/csv.hpp"

namespace tabor::io {
namespace {

template <typename Value>
bool is(const Cell& cell) {
  return std::holds_alternative<Value>(cell);
}

bool is_whole(const Cell& cell) {
  return is<bool>(cell) || is<std::int64_t>(cell) || is<std::uint64_t>(cell);
}

Json value_of(const Cell& cell) {
  return std::visit(
      [](const auto& value) -> Json {
        using Value = std::decay_t<decltype(value)>;
        if constexpr (std::is_same_v<Value, std::monostate>) {
          return nullptr;
        } else if constexpr (std::is_same_v<Value, double>) {
          return number(value);
        } else {
          return value;
        }
      },
      cell);
}

std::string text_of(const Cell& cell) {
  if (const auto* text = std::get_if<std::string>(&cell)) return *text;
  if (const auto* value = std::get_if<bool>(&cell)) return *value ? "true" : "false";
  if (const auto* texts = std::get_if<std::vector<std::string>>(&cell)) {
    return fmt::format("{}", fmt::join(*texts, " "));
  }
  return csv_number(number_in(cell));
}

bool is_text_value(const Json& value) { return value.is_string(); }

void write_attribute(Hdf5Writer& writer, const std::string& path, const std::string& key,
                     const Json& value) {
  if (value.is_boolean()) {
    writer.attribute(path, key, value.get<bool>() ? 1 : 0);
  } else if (value.is_number_integer()) {
    writer.attribute(path, key, value.get<std::int64_t>());
  } else if (value.is_number()) {
    writer.attribute(path, key, value.get<double>());
  } else if (value.is_string()) {
    writer.attribute(path, key, value.get<std::string>());
  } else if (value.is_array() && std::all_of(value.begin(), value.end(), is_text_value)) {
    writer.attribute(path, key, value.get<std::vector<std::string>>());
  }
}

/// What stands at a key, "wear.time_s"; nullptr if nothing does.
const Json* value_at(const Json& object, const std::string& key) {
  const Json* place = &object;
  for (const std::string& name : split(key, '.')) {
    const auto found = place->find(name);
    if (found == place->end()) return nullptr;
    place = &*found;
  }
  return place;
}

}  // namespace

Json json_of(const NamedCells& cells) {
  Json object = Json::object();
  for (const NamedCell& cell : cells) {
    Json* place = &object;
    for (const std::string& name : split(cell.head.key, '.')) place = &(*place)[name];
    *place = value_of(cell.cell);
  }
  return object;
}

void write_attributes(Hdf5Writer& writer, const std::string& path, const NamedCells& cells) {
  for (const auto& [head, cell] : cells) {
    if (is_whole(cell)) {
      writer.attribute(path, head.key, integer_in(cell));
    } else if (const auto* text = std::get_if<std::string>(&cell)) {
      writer.attribute(path, head.key, *text);
    } else if (const auto* texts = std::get_if<std::vector<std::string>>(&cell)) {
      writer.attribute(path, head.key, *texts);
    } else {
      writer.attribute(path, head.key, number_in(cell));
    }
  }
}

void write_members(Hdf5Writer& writer, const std::string& path, const Json& object) {
  for (const auto& [key, value] : object.items()) write_attribute(writer, path, key, value);
}

void write_dataset(Hdf5Writer& writer, const std::string& path, const std::vector<Cell>& cells,
                   const Cell& kind) {
  if (is<std::string>(kind)) {
    std::vector<std::string> values;
    values.reserve(cells.size());
    for (const Cell& cell : cells) values.push_back(text_of(cell));
    writer.write(path, values);
  } else if (is_whole(kind)) {
    std::vector<std::int64_t> values;
    values.reserve(cells.size());
    for (const Cell& cell : cells) values.push_back(is_whole(cell) ? integer_in(cell) : 0);
    writer.write(path, values);
  } else {
    std::vector<double> values;
    values.reserve(cells.size());
    for (const Cell& cell : cells) values.push_back(number_in(cell));
    writer.write(path, values);
  }
}

namespace {

/// A number that the terminal does not show has no style.
std::string style_of(const ColumnHead& head) {
  return head.heading.empty() ? "" : std::string(name_of(head.style.shown));
}

}  // namespace

void describe(Hdf5Writer& writer, const std::string& path, const ColumnHead& head) {
  if (!head.unit.empty()) writer.attribute(path, "units", head.unit);
  if (head.heading.empty()) return;
  writer.attribute(path, "heading", head.heading);
  writer.attribute(path, "style", style_of(head));
}

void write_column_table(Hdf5Writer& writer, const std::vector<ColumnHead>& heads) {
  std::set<std::string> known;
  std::vector<std::string> keys, headings, units, styles;
  for (const ColumnHead& head : heads) {
    if (!known.insert(head.key).second) continue;
    keys.push_back(head.key);
    headings.push_back(head.heading);
    units.push_back(head.unit);
    styles.push_back(style_of(head));
  }
  if (keys.empty()) return;
  writer.write("/columns/key", keys);
  writer.write("/columns/heading", headings);
  writer.write("/columns/units", units);
  writer.write("/columns/style", styles);
}

std::string csv_line_of(const std::vector<Cell>& cells) {
  std::vector<std::string> texts;
  texts.reserve(cells.size());
  for (const Cell& cell : cells) texts.push_back(text_of(cell));
  return csv_line(texts);
}

bool has_cell(const Json& object, const std::string& key) {
  return value_at(object, key) != nullptr;
}

Cell cell_in(const Json& object, const std::string& key) {
  const Json* const place = value_at(object, key);
  if (place == nullptr) throw InputError(key + ": not there");
  if (place->is_null()) return std::numeric_limits<double>::quiet_NaN();
  if (place->is_boolean()) return place->get<bool>();
  if (place->is_number_integer()) return place->get<std::int64_t>();
  if (place->is_number()) return place->get<double>();
  if (place->is_string()) return place->get<std::string>();
  throw InputError(key + ": neither a number nor a text");
}

Cell cell_in(const Hdf5Reader& reader, const std::string& path, const std::string& name,
             const Cell& kind) {
  if (is<std::string>(kind)) return reader.text(path, name);
  if (is<std::vector<std::string>>(kind)) return reader.attribute_texts(path, name);
  return reader.number(path, name);
}

}  // namespace tabor::io
