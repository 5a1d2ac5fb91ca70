#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <filesystem>
#include <optional>
#include <utility>

#include "parameters.hpp"
#include "tabor/cases/slide/slide.hpp"
#include "tabor/results/fields_file.hpp"
#include "tabor/topography/topography.hpp"
#include "values.hpp"
#include "watched.hpp"

namespace tabor::python {
namespace {

using cases::SlideMaps;
using cases::SlideResult;
using cases::SlideSettings;
using topography::Topography;

/// A slide with all that its file is made of.
struct Slid {
  Topography surface;
  cases::CaseSettings settings;
  SlideSettings sliding;
  SlideResult result;
  std::vector<std::optional<SlideMaps>> maps;  ///< of each state
  Field film;                                  ///< that stays on its pixels [m]; empty without oil
};

Slid slide(const Topography& surface, cases::CaseSettings settings, const SlideSettings& sliding,
           double mean_pressure, const std::filesystem::path& checkpoint,
           const nb::object& progress) {
  settings.mean_pressures = {mean_pressure};
  check(cases::objection(sliding, settings, argument_of));
  check(cases::objection(settings.contact, settings.mean_pressures, argument_of));
  check(cases::objection(settings.film));
  check(cases::objection(settings.friction, argument_of, settings.contact.material));
  cases::find_tool(settings.contact.tool, {});
  Slid slid;
  slid.surface = surface;
  slid.settings = settings;
  slid.sliding = sliding;
  const auto receive = [&slid](const cases::SlideState& state) {
    slid.maps.emplace_back();
    if (state.maps != nullptr) slid.maps.back() = *state.maps;
    if (state.film != nullptr && slid.film.size() == 0) slid.film = *state.film;
  };
  slid.result = watched(progress, [&](const Observer& observer) {
    return cases::slide(surface, settings, sliding,
                        {.receive = receive, .wants_maps = true, .checkpoint = checkpoint},
                        observer);
  });
  return slid;
}

/// The numbers of all states by their keys.
nb::dict states_of(const Slid& slid) {
  nb::dict states;
  for (const auto& column : cases::slide_columns(cases::parts_of(slid.settings, slid.sliding))) {
    if (column.key.empty()) continue;  // of the table on the terminal alone
    std::vector<double> values;
    values.reserve(slid.result.states.size());
    for (const cases::SlideRecord& one : slid.result.states) {
      values.push_back(number_in(column.value(one)));
    }
    states[column.key.c_str()] = nb::cast(values);
  }
  return states;
}

/// The maps of a state by their names in a file; None where none are stored.
nb::object maps_of(nb::handle_t<Slid> self, std::size_t state) {
  const Slid& slid = nb::cast<const Slid&>(self);
  if (!slid.maps.at(state)) return nb::none();
  const SlideMaps& maps = *slid.maps[state];
  nb::dict views;
  const auto add = [&](const char* name, const Field& map) {
    if (map.size() > 0) views[name] = nb::cast(view_of(map, self));
  };
  add("sheet", maps.sheet);
  add("pressure", maps.pressure);
  add("gap", maps.gap);
  add("film_thickness", slid.film);
  add("squeezed_film", maps.squeezed);
  add("liquid_pressure", maps.liquid_pressure);
  add("saturation_pressure", maps.saturation_pressure);
  return views;
}

nb::dict dict_of(const cases::SheetSpectra& spectra) {
  nb::dict lists;
  lists["q_x_rad_per_m"] = spectra.q_x;
  lists["psd_x_m3"] = spectra.density_x;
  lists["q_y_rad_per_m"] = spectra.q_y;
  lists["psd_y_m3"] = spectra.density_y;
  return lists;
}

/// Spectra of the sheet before, then of each state.
nb::list spectra_of(const Slid& slid) {
  nb::list all;
  all.append(dict_of(slid.result.before));
  for (const cases::SheetSpectra& one : slid.result.spectra) all.append(dict_of(one));
  return all;
}

void save(const Slid& slid, results::FieldsTarget target) {
  target.origin.path = slid.surface.source;
  watched(nb::none(), [&](const Observer&) {
    results::FieldsFile file(target, slid.surface, slid.settings, slid.sliding);
    const cases::SlideParts parts = cases::parts_of(slid.settings, slid.sliding);
    for (std::size_t i = 0; i < slid.result.states.size(); ++i) {
      file.add(i,
               {.numbers = slid.result.states[i],
                .spectra = slid.result.spectra[i],
                .maps = slid.maps[i] ? &*slid.maps[i] : nullptr,
                .film = slid.film.size() > 0 ? &slid.film : nullptr},
               parts);
    }
    file.add_run(slid.result);
    std::vector<results::Finding> findings =
        results::findings_of({{.pressure = si(slid.settings.mean_pressures.front(), "Pa"),
                               .warnings = slid.result.warnings}});
    results::spell(spelled, findings);
    file.commit(findings);
    return true;
  });
}

}  // namespace

void bind_slide(nb::module_& module) {
  using namespace nb::literals;
  nb::class_<SlideSettings> settings(module, "SlideSettings");
  settings.def(nb::init<>());
  bind_parameters(settings, cases::slide_parameters());
  settings.def_rw("maps_at", &SlideSettings::maps_at);
  nb::class_<Slid>(module, "Slid")
      .def_prop_ro("step", [](const Slid& self) { return self.result.step; })
      .def_prop_ro("steps", [](const Slid& self) { return self.result.steps; })
      .def_prop_ro("steady", [](const Slid& self) { return self.result.steady; })
      .def_prop_ro("converged", [](const Slid& self) { return self.result.converged; })
      .def_prop_ro("references", [](const Slid& self) { return self.result.references; })
      .def_prop_ro("after", [](const Slid& self) { return self.result.after; })
      .def_prop_ro("states", &states_of)
      .def_prop_ro("spectra", &spectra_of)
      .def("maps", &maps_of, "state"_a,
           nb::sig("def maps(self, state: int) -> dict[str, Annotated[NDArray[numpy.float64], "
                   "dict(shape=(None, None), order='C', writable=False)]] | None"))
      .def("save", &save, "target"_a)
      .def_prop_ro("warnings", [](const Slid& self) { return shown(self.result.warnings); });
  module.def("slide", &slide, "surface"_a, "settings"_a, "slide_settings"_a, "mean_pressure"_a,
             "checkpoint"_a, "progress"_a.none());
}

}  // namespace tabor::python
