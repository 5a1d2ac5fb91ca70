#include "values.hpp"

#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <array>
#include <map>
#include <type_traits>
#include <variant>

#include "records.hpp"
#include "tabor/core/error.hpp"
#include "tabor/core/parallel.hpp"
#include "tabor/core/version.hpp"
#include "tabor/io/protection.hpp"

namespace tabor::python {
namespace {

const std::map<std::string_view, Dimension>& dimensions() {
  static const std::map<std::string_view, Dimension> all = {
      {"none", dimension::none},
      {"length", dimension::length},
      {"wavevector", dimension::wavevector},
      {"pressure", dimension::pressure},
      {"areal_density", dimension::areal_density},
      {"density", dimension::density},
      {"speed", dimension::speed},
      {"viscosity", dimension::viscosity},
      {"per_pressure", dimension::per_pressure}};
  return all;
}

nb::object object_of(const Cell& cell) {
  return std::visit(
      [](const auto& value) -> nb::object {
        using Value = std::decay_t<decltype(value)>;
        if constexpr (std::is_same_v<Value, std::monostate>) {
          return nb::none();
        } else {
          return nb::cast(value);
        }
      },
      cell);
}

}  // namespace

std::string name_of(const Dimension& dimension) {
  for (const auto& [name, one] : dimensions()) {
    if (one == dimension) return std::string(name);
  }
  throw InputError("a dimension without a name");
}

MapView view_of(const Field& field, nb::handle owner) {
  const std::array<std::size_t, 2> shape = {static_cast<std::size_t>(field.rows()),
                                            static_cast<std::size_t>(field.cols())};
  return {field.data(), 2, shape.data(), owner};
}

Field field_of(const MapArgument& array) {
  return Eigen::Map<const Field>(array.data(), static_cast<Index>(array.shape(0)),
                                 static_cast<Index>(array.shape(1)));
}

nb::dict dict_of(const NamedCells& cells) {
  nb::dict dict;
  for (const NamedCell& one : cells) dict[one.head.key.c_str()] = object_of(one.cell);
  return dict;
}

Cell cell_of(nb::handle value, const Cell& kind) {
  return std::visit(
      [&value](const auto& example) -> Cell {
        using Value = std::decay_t<decltype(example)>;
        if constexpr (std::is_same_v<Value, std::monostate>) {
          return {};
        } else {
          return nb::cast<Value>(value);
        }
      },
      kind);
}

WarningTexts texts_of(const analysis::Warnings& warnings) {
  WarningTexts texts;
  texts.reserve(warnings.size());
  for (const auto& [code, text, weight] : warnings) texts.emplace_back(code, text, weight);
  return texts;
}

analysis::Warnings warnings_of(const WarningTexts& texts) {
  analysis::Warnings warnings;
  warnings.reserve(texts.size());
  for (const auto& [code, text, weight] : texts) warnings.push_back({code, text, weight});
  return warnings;
}

std::string argument_of(std::string_view setting) {
  static const std::map<std::string_view, std::string_view> others = {
      {"mean_pressure", "pressure"},
      {"lubricant_density", "density"},
      {"sliding_speed", "speed"},
      {"droplet", "droplet_height"}};
  const auto found = others.find(setting);
  return std::string(found == others.end() ? setting : found->second);
}

void check(const std::optional<analysis::Objection>& objection) {
  if (!objection) return;
  if (objection->got.empty()) throw InputError(objection->remedy);
  throw InputError(argument_of(objection->setting), objection->got, objection->expected,
                   objection->remedy);
}

void bind_values(nb::module_& module) {
  io::isolate_hdf5_reading(true);  // a damaged file must not end the session
  module.attr("version") = std::string(kVersion);
  module.def(
      "parse_si",
      [](const std::string& text, const std::string& dimension, const std::string& name) {
        return parse_si(text, dimensions().at(dimension), name);
      },
      nb::arg("text"), nb::arg("dimension"), nb::arg("name"));
  module.def(
      "format_si", [](double value, const std::string& unit) { return si(value, unit); },
      nb::arg("value"), nb::arg("unit"));
  module.def("set_threads", &set_thread_count, nb::arg("n"));
  module.def("threads", &thread_count);
}

}  // namespace tabor::python
