#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include "parameters.hpp"
#include "records.hpp"
#include "tabor/cases/states.hpp"
#include "tabor/contact/contact.hpp"
#include "tabor/contact/patches.hpp"
#include "tabor/material/library.hpp"
#include "tabor/topography/topography.hpp"
#include "watched.hpp"

namespace tabor::python {
namespace {

using cases::ContactRecord;
using cases::ContactSettings;
using contact::State;

/// (name, description, E [Pa], nu, saturation pressure [Pa], shear strength [Pa], source of E)
using MaterialRow = std::tuple<std::string, std::string, double, double, std::optional<double>,
                               std::optional<double>, std::string>;

std::optional<double> value_of(const std::optional<material::Sourced>& number) {
  if (!number) return std::nullopt;
  return number->value;
}

MaterialRow row_of(const material::NamedSolid& solid) {
  return {solid.name,
          solid.description,
          solid.youngs_modulus.value,
          solid.poissons_ratio.value,
          value_of(solid.saturation_pressure),
          value_of(solid.shear_strength),
          solid.youngs_modulus.source};
}

std::vector<MaterialRow> materials() {
  std::vector<MaterialRow> rows;
  for (const material::NamedSolid& solid : material::solids()) rows.push_back(row_of(solid));
  return rows;
}

void check_contact(const ContactSettings& settings, const std::vector<double>& mean_pressures) {
  check(cases::objection(settings, mean_pressures, argument_of));
}

std::vector<ContactRecord> contacts(const topography::Topography& surface,
                                    const ContactSettings& settings,
                                    const std::vector<double>& mean_pressures,
                                    const std::vector<double>& separations,
                                    const std::vector<double>& forces, const nb::object& progress) {
  cases::CaseSettings asked{.mean_pressures = mean_pressures,
                            .separations = separations,
                            .forces = forces,
                            .contact = settings};
  check(cases::objection_to_controls(asked, true, argument_of));
  check_contact(settings, mean_pressures);
  cases::find_tool(asked.contact.tool, {});
  return watched(progress, [&](const Observer& observer) {
    const std::vector<contact::Control> controls = cases::controls_of(asked);
    std::vector<ContactRecord> records;
    records.reserve(controls.size());
    const auto elasticity = cases::make_operator(asked.contact, surface.grid);
    cases::contact_states(
        *elasticity, surface, asked.contact, controls,
        [&records](ContactRecord&& record) { records.push_back(std::move(record)); }, observer);
    return records;
  });
}

using Scalars = std::tuple<int, double, double, double, int, std::uint64_t>;
using ContactState = std::tuple<nb::dict, Scalars, WarningTexts, std::vector<std::string>,
                                MapArgument, MapArgument, MapArgument, nb::object>;

/// Returns the heights of the tool over the surface; None under a flat.
nb::object tool_of(nb::handle_t<ContactRecord> self) {
  const auto& one = nb::cast<const ContactRecord&>(self);
  return one.tool ? nb::cast(view_of(*one.tool, self)) : nb::none();
}

nb::object saved_contact(nb::handle_t<ContactRecord> self) {
  const auto& one = nb::cast<const ContactRecord&>(self);
  const State& state = one.state;
  return nb::cast(
      std::make_tuple(saved(cases::contact_columns(), one),
                      Scalars{static_cast<int>(one.convergence.status), one.convergence.fft_pairs,
                              state.gap_error, state.gap_limit, state.compact_steps, one.surface},
                      python::texts_of(one.warnings), one.references, view_of(state.pressure, self),
                      view_of(state.displacement, self), view_of(state.gap, self), tool_of(self)));
}

void restore_contact(ContactRecord& self, const ContactState& saved) {
  auto& one = *new (&self) ContactRecord();
  restore(cases::contact_columns(), std::get<0>(saved), one);
  int status = 0;
  State& state = one.state;
  std::tie(status, one.convergence.fft_pairs, state.gap_error, state.gap_limit, state.compact_steps,
           one.surface) = std::get<1>(saved);
  one.convergence.status = static_cast<Status>(status);
  one.warnings = warnings_of(std::get<2>(saved));
  one.references = std::get<3>(saved);
  state.pressure = field_of(std::get<4>(saved));
  state.displacement = field_of(std::get<5>(saved));
  state.gap = field_of(std::get<6>(saved));
  if (const nb::object& tool = std::get<7>(saved); !tool.is_none()) {
    one.tool = std::make_shared<const Field>(field_of(nb::cast<MapArgument>(tool)));
  }
  state.mean_pressure = one.summary.mean_pressure;
  state.separation = one.summary.separation;
  state.convergence = one.convergence;
}

/// A map of a contact as a property.
template <Field State::*map>
MapView map_of(nb::handle_t<ContactRecord> self) {
  return view_of(nb::cast<const ContactRecord&>(self).state.*map, self);
}

OwnMap<Mask> touching(const ContactRecord& one) {
  return handed_over(contact::contact_mask(one.state));
}

OwnMap<Mask> saturated(const ContactRecord& one, const ContactSettings& settings) {
  return handed_over(contact::saturated_mask(one.state, settings.pressure_cap()));
}

OwnMap<contact::LabelMap> patches(const ContactRecord& one, const ContactSettings& settings) {
  return handed_over(
      contact::label_patches(contact::contact_mask(one.state), settings.is_periodic()));
}

/// Takes the boundary from what is said about the edges of the surface; both must agree.
void take_edges(ContactSettings& settings, const topography::Topography& surface) {
  if (const auto found = cases::objection(settings, surface.edges)) throw InputError(found->remedy);
  settings.take_edges(surface.edges);
}

/// Presses with a surface in place of a flat.
void take_tool(ContactSettings& settings, const topography::Topography& surface) {
  cases::take_tool(settings.tool, surface);
}

void bind_settings(nb::module_& module) {
  using namespace nb::literals;
  nb::class_<ContactSettings> settings(module, "ContactSettings");
  settings.def(nb::init<>())
      .def_rw("material", &ContactSettings::material)
      .def_prop_ro("effective_modulus", &ContactSettings::effective_modulus)
      .def("take_edges", &take_edges, "surface"_a)
      .def("take_tool", &take_tool, "surface"_a);
  bind_parameters(settings, cases::contact_parameters());
}

}  // namespace

void bind_contact(nb::module_& module) {
  using namespace nb::literals;
  bind_settings(module);
  nb::class_<ContactRecord>(module, "ContactRecord")
      .def("__getstate__", &saved_contact)
      .def("__setstate__", &restore_contact)
      .def_prop_ro("values",
                   [](const ContactRecord& self) {
                     return dict_of(cells_of(cases::contact_columns(), self));
                   })
      .def_prop_ro("warnings", [](const ContactRecord& self) { return shown(self.warnings); })
      .def_ro("references", &ContactRecord::references)
      .def_ro("surface", &ContactRecord::surface)
      .def_prop_ro("converged",
                   [](const ContactRecord& self) { return self.convergence.converged(); })
      .def_prop_ro("gap_limit", [](const ContactRecord& self) { return self.state.gap_limit; })
      .def("touching", &touching)
      .def("saturated", &saturated, "settings"_a)
      .def("patches", &patches, "settings"_a)
      .def_prop_ro("pressure", &map_of<&State::pressure>)
      .def_prop_ro("displacement", &map_of<&State::displacement>)
      .def_prop_ro("gap", &map_of<&State::gap>)
      .def_prop_ro(
          "tool", &tool_of,
          nb::for_getter(nb::sig("def tool(self) -> Annotated[NDArray[numpy.float64], "
                                 "dict(shape=(None, None), order='C', writable=False)] | None")));
  module.def("materials", &materials);
  module.def(
      "material", [](const std::string& name) { return row_of(material::find_solid(name)); },
      "name"_a);
  module.def("check_contact", &check_contact, "settings"_a, "mean_pressures"_a);
  module.def("contacts", &contacts, "surface"_a, "settings"_a, "mean_pressures"_a, "separations"_a,
             "forces"_a, "progress"_a.none());
}

}  // namespace tabor::python
