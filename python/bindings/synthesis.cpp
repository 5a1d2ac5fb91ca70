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

topography::Topography generate(const Request& request) {
  return watched(nb::none(), [&](const Observer&) {
    topography::Topography surface =
        synthesis::generate(request, [](std::string_view name) { return std::string(name); });
    surface.format = "generated";
    surface.warnings = topography::warnings(surface);
    return surface;
  });
}

/// (name, dimension, help)
using NumberRow = std::tuple<std::string, std::string, std::string>;
std::vector<NumberRow> numbers() {
  std::vector<NumberRow> rows;
  rows.reserve(synthesis::recipe_numbers().size());
  for (const synthesis::RecipeNumber& one : synthesis::recipe_numbers()) {
    rows.emplace_back(one.name, name_of(one.dimension), one.help);
  }
  return rows;
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

void set_stage(Request& request, const std::string& stage) {
  if (stage != "before" && stage != "after") {
    throw InputError("stage", "'" + stage + "'", "before or after", "");
  }
  request.stage = stage == "after" ? synthesis::EdtStage::after : synthesis::EdtStage::before;
}

}  // namespace

void bind_synthesis(nb::module_& module) {
  using namespace nb::literals;
  nb::class_<Request>(module, "GenerateRequest")
      .def(nb::init<>())
      .def_rw("kind", &Request::kind)
      .def_rw("numbers", &Request::numbers)
      .def_rw("periodic", &Request::periodic)
      .def_rw("random_amplitudes", &Request::random_amplitudes)
      .def_rw("seed", &Request::seed)
      .def("set_stage", &set_stage, "stage"_a)
      .def(
          "set_grid",
          [](Request& self, Index nx, Index ny, double dx, double dy) {
            self.grid = {nx, ny, static_cast<double>(nx) * dx, static_cast<double>(ny) * dy};
          },
          "nx"_a, "ny"_a, "dx"_a, "dy"_a);
  module.def("generate", &generate, "request"_a);
  module.def("recipe_numbers", &numbers);
  module.def("recipe_kinds", &synthesis::recipe_kinds);
  module.def("formats", &formats);
}

}  // namespace tabor::python
