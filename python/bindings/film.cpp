#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include "parameters.hpp"
#include "records.hpp"
#include "tabor/cases/states.hpp"
#include "tabor/topography/topography.hpp"
#include "watched.hpp"

namespace tabor::python {
namespace {

using cases::FilmRecord;
using cases::FilmSettings;

std::vector<FilmRecord> rain(const topography::Topography& surface, const FilmSettings& settings,
                             const nb::object& progress) {
  check(cases::objection(settings));
  return watched(progress, [&](const Observer& observer) {
    return cases::film_state(surface, settings, observer);
  });
}

/// (numbers, (density [kg/m^2], digest of the surface), warnings, references, map)
using FilmState = std::tuple<nb::dict, std::pair<double, std::uint64_t>, WarningTexts,
                             std::vector<std::string>, MapArgument>;

nb::object saved_film(nb::handle_t<FilmRecord> self) {
  const auto& one = nb::cast<const FilmRecord&>(self);
  return nb::cast(std::make_tuple(
      saved(cases::film_columns(), one), std::make_pair(one.lubricant_density, one.surface),
      python::texts_of(one.warnings), one.references, view_of(one.film.thickness, self)));
}

void restore_film(FilmRecord& self, const FilmState& saved) {
  auto& one = *new (&self) FilmRecord();
  restore(cases::film_columns(), std::get<0>(saved), one);
  std::tie(one.lubricant_density, one.surface) = std::get<1>(saved);
  one.warnings = warnings_of(std::get<2>(saved));
  one.references = std::get<3>(saved);
  one.film.thickness = field_of(std::get<4>(saved));
}

void bind_settings(nb::module_& module) {
  nb::class_<FilmSettings> settings(module, "FilmSettings");
  settings.def(nb::init<>()).def_rw("lubricant_densities", &FilmSettings::lubricant_densities);
  bind_parameters(settings, cases::film_parameters());
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
          [](const FilmRecord& self) { return dict_of(cells_of(cases::film_columns(), self)); })
      .def_prop_ro("warnings", [](const FilmRecord& self) { return shown(self.warnings); })
      .def_ro("references", &FilmRecord::references)
      .def_ro("surface", &FilmRecord::surface)
      .def_ro("lubricant_density", &FilmRecord::lubricant_density)
      .def_prop_ro("thickness", [](nb::handle_t<FilmRecord> self) {
        return view_of(nb::cast<const FilmRecord&>(self).film.thickness, self);
      });
  module.def("rain", &rain, "surface"_a, "settings"_a, "progress"_a.none());
}

}  // namespace tabor::python
