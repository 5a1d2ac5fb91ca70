#include "values.hpp"

#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <type_traits>
#include <variant>

#include "parameters.hpp"
#include "records.hpp"
#include "tabor/core/error.hpp"
#include "tabor/core/parallel.hpp"
#include "tabor/core/text.hpp"
#include "tabor/core/version.hpp"
#include "tabor/io/files/protection.hpp"
#include "tabor/scan/read_parameters.hpp"
#include "tabor/spectral/fft.hpp"
#include "tabor/topography/treatment.hpp"

namespace tabor::python {
namespace {

const std::map<std::string_view, Dimension>& dimensions() {
  static const std::map<std::string_view, Dimension> all = {
      {"none", dimension::none},
      {"force", dimension::force},
      {"length", dimension::length},
      {"wavevector", dimension::wavevector},
      {"pressure", dimension::pressure},
      {"areal_density", dimension::areal_density},
      {"density", dimension::density},
      {"speed", dimension::speed},
      {"viscosity", dimension::viscosity},
      {"per_pressure", dimension::per_pressure},
      {"pressure_gradient", dimension::pressure_gradient}};
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

nb::object given_value(const Cell& cell) {
  const auto* number = std::get_if<double>(&cell);
  return number != nullptr && std::isnan(*number) ? nb::none() : object_of(cell);
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

WarningTexts texts_of(const Warnings& warnings) {
  WarningTexts texts;
  texts.reserve(warnings.size());
  for (const auto& [code, text, weight] : warnings) texts.emplace_back(code, text, weight);
  return texts;
}

ShownWarnings shown(Warnings warnings) {
  std::stable_sort(warnings.begin(), warnings.end(), [](const auto& a, const auto& b) {
    return cases::class_of(a.code) < cases::class_of(b.code);
  });
  ShownWarnings list;
  list.reserve(warnings.size());
  for (const Warning& one : warnings) {
    list.emplace_back(one.code, advised(one.text, spelled),
                      cases::name_of(cases::class_of(one.code)));
  }
  return list;
}

namespace {

/// Returns a setting of cases or of reading scans; null where there is none.
const ParameterHead* parameter_of(std::string_view setting) {
  if (const ParameterHead* const found = cases::find_parameter(setting)) return found;
  for (const ParameterHead& one : scan::read_parameters()) {
    if (one.name == setting) return &one;
  }
  return nullptr;
}

}  // namespace

std::string spelled(const Advice& advice) {
  static const std::set<std::string_view> others = {"edges",   "fit_max",    "fit_min",
                                                    "density", "fields",     "group",
                                                    "keep",    "tip_radius", "threshold"};
  static const std::map<std::string_view, std::string> renamed = {{"no_register", "search=False"},
                                                                  {"shift", "shift=(dx, dy)"}};
  const auto found = renamed.find(advice.setting);
  if (found != renamed.end()) return found->second;
  for (const topography::StepDescription& step : topography::treatment_steps()) {
    if (step.name != advice.setting) continue;
    const std::string value = advice.value.empty() ? "..." : advice.value;
    return "treat('" + step.name + (step.argument.empty() ? "" : "=" + value) + "')";
  }
  const ParameterHead* const known = parameter_of(advice.setting);
  if (known == nullptr && !others.contains(advice.setting)) return "";
  const std::string name = argument_of(advice.setting) + "=";
  if (known != nullptr && known->kind == ValueKind::flag) return name + "True";
  const bool is_number = parse_number(advice.value).has_value();
  if (advice.value.empty() || is_number) return name + advice.value;
  return name + "'" + advice.value + "'";
}

Warnings warnings_of(const WarningTexts& texts) {
  Warnings warnings;
  warnings.reserve(texts.size());
  for (const auto& [code, text, weight] : texts) warnings.push_back({code, text, weight});
  return warnings;
}

std::string argument_of(std::string_view setting) {
  const ParameterHead* const found = cases::find_parameter(setting);
  return found != nullptr ? found->python_argument() : std::string(setting);
}

void check(const std::optional<cases::Objection>& objection) {
  if (!objection) return;
  if (objection->got.empty()) throw InputError(objection->remedy);
  throw InputError(argument_of(objection->setting), objection->got, objection->expected,
                   objection->remedy);
}

void bind_values(nb::module_& module) {
  io::isolate_hdf5_reading(true);  // a damaged file must not end the session
  module.def(
      "advised", [](const std::string& text) { return advised(text, spelled); }, nb::arg("text"));
  module.attr("version") = std::string(kVersion);
  module.attr("transforms") = spectral::transform_library();
  module.def("si_units", [] {
    nb::dict units;
    for (const auto& [name, one] : dimensions()) units[name.data()] = si_unit(one);
    return units;
  });
  module.def(
      "parse_si",
      [](const std::string& text, const std::string& dimension, const std::string& name) {
        return parse_si(text, dimensions().at(dimension), name);
      },
      nb::arg("text"), nb::arg("dimension"), nb::arg("name"));
  module.def(
      "parse_si_list",
      [](const std::string& text, const std::string& dimension, const std::string& name) {
        return parse_si_list(text, dimensions().at(dimension), name);
      },
      nb::arg("text"), nb::arg("dimension"), nb::arg("name"));
  module.def(
      "format_si", [](double value, const std::string& unit) { return si(value, unit); },
      nb::arg("value"), nb::arg("unit"));
  module.def("set_threads", &set_thread_count, nb::arg("n"));
  module.def("threads", &thread_count);
}

}  // namespace tabor::python
