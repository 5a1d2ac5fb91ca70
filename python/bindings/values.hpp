#pragma once

#include <nanobind/ndarray.h>

#include <array>
#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "bindings.hpp"
#include "tabor/cases/settings.hpp"
#include "tabor/cases/warning.hpp"
#include "tabor/core/advice.hpp"
#include "tabor/core/column.hpp"
#include "tabor/core/types.hpp"
#include "tabor/core/units.hpp"

// What goes between C++ and Python: maps, records, warnings and objections.
namespace tabor::python {

/// A map as a read-only array of NumPy; it is not copied and keeps its owner alive.
using MapView = nb::ndarray<nb::numpy, const double, nb::ndim<2>, nb::c_contig>;
MapView view_of(const Field& field, nb::handle owner);

/// A map that was made for Python, which owns it.
template <typename Map>
using OwnMap = nb::ndarray<nb::numpy, const typename Map::Scalar, nb::ndim<2>, nb::c_contig>;
template <typename Map>
OwnMap<Map> handed_over(Map map) {
  auto kept = std::make_unique<Map>(std::move(map));
  const std::array<std::size_t, 2> shape = {static_cast<std::size_t>(kept->rows()),
                                            static_cast<std::size_t>(kept->cols())};
  const auto* data = kept->data();
  const nb::capsule owner(
      kept.get(), [](void* one) noexcept { std::default_delete<Map>()(static_cast<Map*>(one)); });
  static_cast<void>(kept.release());
  return {data, 2, shape.data(), owner};
}

/// Heights or films that Python hands over: C-ordered float64 of shape (ny, nx).
using MapArgument = nb::ndarray<const double, nb::ndim<2>, nb::c_contig, nb::device::cpu>;
Field field_of(const MapArgument& array);

/// The numbers of a record by the names of `--json`; a NaN stays one.
nb::dict dict_of(const NamedCells& cells);

/// (code, text, weight) of each.
using WarningTexts = std::vector<std::tuple<std::string, std::string, double>>;
WarningTexts texts_of(const Warnings& warnings);
/// Warnings before information: (code, text, class), with settings spelled as arguments.
using ShownWarnings = std::vector<std::tuple<std::string, std::string, std::string>>;
ShownWarnings shown(Warnings warnings);
/// How Python writes what a warning advises: treat("level=plane"), boundary='free'.
std::string spelled(const Advice& advice);
Warnings warnings_of(const WarningTexts& texts);

/// "length", as parse_si of the module takes it.
std::string name_of(const Dimension& dimension);

/// How the package calls what analysis calls by this name.
std::string argument_of(std::string_view setting);
/// Throws what analysis objects to.
void check(const std::optional<cases::Objection>& objection);

}  // namespace tabor::python
