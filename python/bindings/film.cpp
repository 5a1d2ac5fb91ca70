#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include "records.hpp"
#include "tabor/analysis/states.hpp"
#include "tabor/topography/topography.hpp"
#include "watched.hpp"

namespace tabor::python {
namespace {

using analysis::FilmRecord;
using analysis::FilmSettings;

std::vector<FilmRecord> rain(const topography::Topography& surface, const FilmSettings& settings,
                             const nb::object& progress) {
  check(analysis::objection(settings));
  return watched(progress, [&](const Observer& observer) {
    return analysis::film_state(surface, settings, observer);
  });
}

using FilmState = std::tuple<nb::dict, double, WarningTexts, std::vector<std::string>, MapArgument>;

nb::object saved_film(nb::handle_t<FilmRecord> self) {
  const auto& one = nb::cast<const FilmRecord&>(self);
  return nb::cast(std::make_tuple(saved(analysis::film_columns(), one), one.lubricant_density,
                                  texts_of(one.warnings), one.references,
                                  view_of(one.film.thickness, self)));
}

void restore_film(FilmRecord& self, const FilmState& saved) {
  auto& one = *new (&self) FilmRecord();
  restore(analysis::film_columns(), std::get<0>(saved), one);
  one.lubricant_density = std::get<1>(saved);
  one.warnings = warnings_of(std::get<2>(saved));
  one.references = std::get<3>(saved);
  one.film.thickness = field_of(std::get<4>(saved));
}

void bind_settings(nb::module_& module) {
  nb::class_<FilmSettings>(module, "FilmSettings")
      .def(nb::init<>())
      .def_rw("lubricant_densities", &FilmSettings::lubricant_densities)
      .def_rw("oil_density", &FilmSettings::oil_density)
      .def_rw("droplet_height", &FilmSettings::droplet_height)
      .def_rw("seed", &FilmSettings::seed)
      .def_prop_rw(
          "model", [](const FilmSettings& self) { return deposition::name(self.model); },
          [](FilmSettings& self, const std::string& name) {
            self.model = deposition::kModels.parse(name, "model");
          })
      .def_prop_rw(
          "reading", [](const FilmSettings& self) { return deposition::name(self.reading); },
          [](FilmSettings& self, const std::string& name) {
            self.reading = deposition::kReadings.parse(name, "reading");
          })
      .def_prop_rw(
          "edge", [](const FilmSettings& self) { return deposition::name(self.edge); },
          [](FilmSettings& self, const std::string& name) {
            self.edge = deposition::kEdges.parse(name, "edge");
          });
}

}  // namespace

void bind_film(nb::module_& module) {
  using namespace nb::literals;
  bind_settings(module);
  nb::class_<FilmRecord>(module, "FilmRecord")
      .def("__getstate__", &saved_film)
      .def("__setstate__", &restore_film)
      .def_prop_ro(
          "values",
          [](const FilmRecord& self) { return dict_of(cells_of(analysis::film_columns(), self)); })
      .def_prop_ro("warnings", [](const FilmRecord& self) { return texts_of(self.warnings); })
      .def_ro("references", &FilmRecord::references)
      .def_ro("lubricant_density", &FilmRecord::lubricant_density)
      .def_prop_ro("thickness", [](nb::handle_t<FilmRecord> self) {
        return view_of(nb::cast<const FilmRecord&>(self).film.thickness, self);
      });
  module.def("rain", &rain, "surface"_a, "settings"_a, "progress"_a.none());
}

}  // namespace tabor::python
