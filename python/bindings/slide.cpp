#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include "parameters.hpp"
#include "tabor/cases/slide.hpp"
#include "tabor/topography/topography.hpp"
#include "values.hpp"
#include "watched.hpp"

namespace tabor::python {
namespace {

using cases::SlideResult;
using cases::SlideSettings;
using topography::Topography;

SlideResult slide(const Topography& surface, cases::CaseSettings settings,
                  const SlideSettings& sliding, double mean_pressure, const nb::object& progress) {
  settings.mean_pressures = {mean_pressure};
  check(cases::objection(sliding, settings, argument_of));
  check(cases::objection(settings.contact, settings.mean_pressures, argument_of));
  check(cases::objection(settings.film));
  check(cases::objection(settings.friction, argument_of, settings.contact.material));
  cases::find_tool(settings.contact.tool, {});
  return watched(progress, [&](const Observer& observer) {
    return cases::slide(surface, settings, sliding, {}, observer);
  });
}

/// The numbers of all states by their keys.
nb::dict states_of(const SlideResult& result) {
  nb::dict states;
  for (const auto& column : cases::slide_columns()) {
    std::vector<double> values;
    values.reserve(result.states.size());
    for (const cases::SlideRecord& one : result.states) {
      values.push_back(number_in(column.value(one)));
    }
    states[column.key.c_str()] = nb::cast(values);
  }
  return states;
}

}  // namespace

void bind_slide(nb::module_& module) {
  using namespace nb::literals;
  nb::class_<SlideSettings> settings(module, "SlideSettings");
  settings.def(nb::init<>());
  bind_parameters(settings, cases::slide_parameters());
  nb::class_<SlideResult>(module, "SlideResult")
      .def_ro("step", &SlideResult::step)
      .def_ro("steps", &SlideResult::steps)
      .def_ro("converged", &SlideResult::converged)
      .def_ro("references", &SlideResult::references)
      .def_ro("after", &SlideResult::after)
      .def_prop_ro("states", &states_of)
      .def_prop_ro("warnings", [](const SlideResult& self) { return shown(self.warnings); });
  module.def("slide", &slide, "surface"_a, "settings"_a, "slide_settings"_a, "mean_pressure"_a,
             "progress"_a.none());
}

}  // namespace tabor::python
