#include <nanobind/stl/map.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include "tabor/core/error.hpp"
#include "tabor/scan/file.hpp"
#include "tabor/synthesis/recipes.hpp"
#include "tabor/topography/warnings.hpp"
#include "values.hpp"
#include "watched.hpp"

namespace tabor::python {
namespace {

using synthesis::Request;

std::string same(std::string_view name) { return std::string(name); }

topography::Topography generate(const Request& request) {
  return watched(nb::none(), [&](const Observer&) {
    topography::Topography surface = synthesis::generate(request, same);
    surface.format = "generated";
    surface.warnings = topography::warnings(surface);
    return surface;
  });
}

/// (name, description, extensions, reads, writes, through gwyddion)
using FormatRow = std::tuple<std::string, std::string, std::vector<std::string>, bool, bool, bool>;
std::vector<FormatRow> formats() {
  std::vector<FormatRow> rows;
  rows.reserve(scan::formats().size());
  for (const scan::FormatRow& one : scan::formats()) {
    rows.emplace_back(one.name, one.description, one.extensions, one.reads, one.writes,
                      one.via_gwyddion);
  }
  return rows;
}

/// A value of a recipe: a number, a switch or a word.
void set(Request& request, const std::string& name, nb::handle value) {
  Cell& cell = request.settings[name];
  if (nb::isinstance<nb::bool_>(value)) {
    cell = nb::cast<bool>(value);
  } else if (nb::isinstance<nb::str>(value)) {
    cell = nb::cast<std::string>(value);
  } else {
    cell = nb::cast<double>(value);
  }
}

}  // namespace

void bind_synthesis(nb::module_& module) {
  using namespace nb::literals;
  nb::class_<Request>(module, "GenerateRequest")
      .def(nb::init<>())
      .def_rw("kind", &Request::kind)
      .def_rw("seed", &Request::seed)
      .def("set", &set, "name"_a, "value"_a)
      .def(
          "set_grid",
          [](Request& self, const std::vector<double>& pixels, const std::vector<double>& pixel) {
            self.grid = synthesis::grid_of({.pixels = pixels, .pixel = pixel}, same);
          },
          "pixels"_a, "pixel"_a);
  module.def("generate", &generate, "request"_a);
  module.def("recipe_kinds", [] { return synthesis::recipe_kinds(); });
  module.def("formats", &formats);
}

}  // namespace tabor::python
