#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include "records.hpp"
#include "tabor/analysis/density_curve.hpp"
#include "tabor/analysis/states.hpp"
#include "tabor/core/error.hpp"
#include "tabor/topography/topography.hpp"
#include "watched.hpp"

namespace tabor::python {
namespace {

using analysis::ContactRecord;
using analysis::ContactSettings;
using analysis::DensityCurve;
using analysis::FilmRecord;
using analysis::FluidRecord;
using analysis::FluidSettings;
using analysis::FrictionRecord;
using analysis::FrictionSettings;
using topography::Topography;

/// What a friction is computed from.
struct Pair {
  const Topography& surface;
  const ContactRecord& contact;
  const FilmRecord& film;
};

void require_one_shape(const Pair& pair) {
  const Field& film = pair.film.film.thickness;
  const Field& gap = pair.contact.state.gap;
  if (film.rows() == gap.rows() && film.cols() == gap.cols()) return;
  const auto shape = [](const Field& map) {
    return "(" + std::to_string(map.rows()) + ", " + std::to_string(map.cols()) + ")";
  };
  throw InputError("film", "shape " + shape(film), "that of the contact, " + shape(gap),
                   "rain on the surface of the contact");
}

FrictionRecord friction_of(const Pair& pair, const FluidRecord* fluid,
                           const ContactSettings& contact, const FrictionSettings& settings) {
  const Mask mask = contact::contact_mask(pair.contact.state);
  return analysis::friction_state(pair.contact, {mask, pair.contact.state.gap, pair.surface.grid},
                                  pair.film, fluid, contact, settings);
}

/// (numbers, whether oil flows, area, warnings, references)
using FrictionState =
    std::tuple<nb::dict, bool, std::string, WarningTexts, std::vector<std::string>>;

FrictionState saved_friction(const FrictionRecord& one) {
  const bool flows = one.fluid.has_value();
  return {saved(analysis::friction_columns(flows), one), flows,
          std::string(tabor::friction::kAreas.of(one.area)), texts_of(one.warnings),
          one.references};
}

void restore_friction(FrictionRecord& self, const FrictionState& saved) {
  auto& one = *new (&self) FrictionRecord();
  if (std::get<1>(saved)) one.fluid.emplace();
  restore(analysis::friction_columns(std::get<1>(saved)), std::get<0>(saved), one);
  one.area = tabor::friction::kAreas.parse(std::get<2>(saved), "area");
  one.warnings = warnings_of(std::get<3>(saved));
  one.references = std::get<4>(saved);
}

/// (numbers, speed [m/s], status, warnings, references, maps)
using FluidState = std::tuple<nb::dict, double, int, WarningTexts, std::vector<std::string>,
                              MapArgument, MapArgument, MapArgument, MapArgument>;

nb::object saved_fluid(nb::handle_t<FluidRecord> self) {
  const auto& one = nb::cast<const FluidRecord&>(self);
  const tabor::friction::FluidFilmState& state = one.state;
  return nb::cast(std::make_tuple(
      saved(analysis::fluid_columns(), one), one.sliding_speed,
      static_cast<int>(one.summary.convergence.status), texts_of(one.warnings), one.references,
      view_of(state.film.pressure, self), view_of(state.film.fill, self),
      view_of(state.contact.gap, self), view_of(state.contact.pressure, self)));
}

void restore_fluid(FluidRecord& self, const FluidState& saved) {
  auto& one = *new (&self) FluidRecord();
  restore(analysis::fluid_columns(), std::get<0>(saved), one);
  one.sliding_speed = std::get<1>(saved);
  one.summary.convergence.status = static_cast<Status>(std::get<2>(saved));
  one.warnings = warnings_of(std::get<3>(saved));
  one.references = std::get<4>(saved);
  one.state.film.pressure = field_of(std::get<5>(saved));
  one.state.film.fill = field_of(std::get<6>(saved));
  one.state.contact.gap = field_of(std::get<7>(saved));
  one.state.contact.pressure = field_of(std::get<8>(saved));
}

FrictionRecord friction(const Topography& surface, const ContactRecord& contact,
                        const FilmRecord& film, const ContactSettings& contact_settings,
                        const FrictionSettings& settings) {
  check(analysis::objection(settings, argument_of));
  const Pair pair{surface, contact, film};
  require_one_shape(pair);
  return watched(nb::none(), [&](const Observer&) {
    return friction_of(pair, nullptr, contact_settings, settings);
  });
}

/// The flowing film, and friction with it.
std::pair<FluidRecord, FrictionRecord> fluid_film(
    const Topography& surface, const ContactRecord& contact, const FilmRecord& film,
    const ContactSettings& contact_settings, const FluidSettings& fluid_settings,
    const FrictionSettings& settings, const nb::object& progress) {
  check(analysis::objection(fluid_settings, contact_settings, argument_of));
  check(analysis::objection(settings, argument_of));
  const Pair pair{surface, contact, film};
  require_one_shape(pair);
  return watched(progress, [&](const Observer& observer) {
    const auto elasticity = analysis::make_operator(contact_settings, surface.grid);
    FluidRecord flowing = analysis::fluid_state(*elasticity, surface.height, contact.state,
                                                contact.summary.mean_pressure, film.film.thickness,
                                                contact_settings, fluid_settings, observer);
    FrictionRecord record = friction_of(pair, &flowing, contact_settings, settings);
    return std::make_pair(std::move(flowing), std::move(record));
  });
}

using Numbers = std::vector<double>;
/// (pressure [Pa], dry friction, densities [kg/m^2], wet shares, friction, plateau)
using CurveRow = std::tuple<double, double, Numbers, Numbers, Numbers,
                            std::optional<std::tuple<double, double, double>>>;
CurveRow row_of(const DensityCurve& curve) {
  std::optional<std::tuple<double, double, double>> plateau;
  if (curve.plateau) {
    plateau.emplace(curve.plateau->first, curve.plateau->last, curve.plateau->value);
  }
  return {curve.mean_pressure,     curve.friction_dry,        curve.lubricant_densities,
          curve.lubricated_shares, curve.friction_lubricated, plateau};
}

DensityCurve curve_of(const CurveRow& row) {
  DensityCurve curve;
  std::tie(curve.mean_pressure, curve.friction_dry, curve.lubricant_densities,
           curve.lubricated_shares, curve.friction_lubricated, std::ignore) = row;
  if (const auto& plateau = std::get<5>(row)) {
    curve.plateau = std::make_from_tuple<analysis::Plateau>(*plateau);
  }
  return curve;
}

/// One for each of these contacts with the surface.
std::vector<CurveRow> density_curves(const Topography& surface,
                                     const std::vector<const ContactRecord*>& contacts,
                                     const ContactSettings& contact,
                                     const analysis::FilmSettings& film,
                                     const FrictionSettings& friction, const nb::object& progress) {
  check(analysis::objection(film));
  check(analysis::objection(friction, argument_of));
  const auto curves = watched(progress, [&](const Observer& observer) {
    std::vector<analysis::Touching> touching;
    touching.reserve(contacts.size());
    for (const ContactRecord* one : contacts) {
      touching.push_back({one->summary, contact::contact_mask(one->state)});
    }
    const analysis::CaseSettings settings{.contact = contact, .film = film, .friction = friction};
    return analysis::density_curves(surface, touching, settings, observer);
  });
  std::vector<CurveRow> rows;
  rows.reserve(curves.size());
  for (const DensityCurve& curve : curves) rows.push_back(row_of(curve));
  return rows;
}

std::string sentence(const CurveRow& curve, const Numbers& asked) {
  return analysis::sentence_of(curve_of(curve), asked);
}

void bind_settings(nb::module_& module) {
  nb::class_<FrictionSettings>(module, "FrictionSettings")
      .def(nb::init<>())
      .def_rw("shear_strength", &FrictionSettings::shear_strength)
      .def_rw("boundary_shear_strength", &FrictionSettings::boundary_shear_strength)
      .def_rw("boundary_shear_share", &FrictionSettings::boundary_shear_share)
      .def_prop_rw(
          "area",
          [](const FrictionSettings& self) {
            return self.area ? std::optional(tabor::friction::kAreas.of(*self.area)) : std::nullopt;
          },
          [](FrictionSettings& self, const std::optional<std::string>& name) {
            self.area.reset();
            if (name) self.area = tabor::friction::kAreas.parse(*name, "area");
          },
          nb::for_setter(nb::arg("name").none()));
  nb::class_<FluidSettings>(module, "FluidSettings")
      .def(
          "__init__",
          [](FluidSettings* self) { new (self) FluidSettings{.fluid = analysis::Fluid::reynolds}; })
      .def_rw("sliding_speed", &FluidSettings::sliding_speed)
      .def_rw("viscosity", &FluidSettings::viscosity)
      .def_rw("pressure_viscosity", &FluidSettings::pressure_viscosity)
      .def_rw("eyring_stress", &FluidSettings::eyring_stress);
}

/// Access to a map of a flowing film as a property.
template <typename Access>
auto map_of(Access access) {
  return [access](nb::handle_t<FluidRecord> self) {
    return view_of(access(nb::cast<const FluidRecord&>(self).state), self);
  };
}

}  // namespace

void bind_friction(nb::module_& module) {
  using namespace nb::literals;
  using State = tabor::friction::FluidFilmState;
  bind_settings(module);
  nb::class_<FrictionRecord>(module, "FrictionRecord")
      .def("__getstate__", &saved_friction)
      .def("__setstate__", &restore_friction)
      .def_prop_ro("values",
                   [](const FrictionRecord& self) {
                     return dict_of(cells_of(analysis::friction_columns(), self));
                   })
      .def_prop_ro("warnings", [](const FrictionRecord& self) { return texts_of(self.warnings); })
      .def_ro("references", &FrictionRecord::references);
  nb::class_<FluidRecord>(module, "FluidRecord")
      .def("__getstate__", &saved_fluid)
      .def("__setstate__", &restore_fluid)
      .def_prop_ro("pressure", map_of([](const State& s) -> auto& { return s.film.pressure; }))
      .def_prop_ro("fill", map_of([](const State& s) -> auto& { return s.film.fill; }))
      .def_prop_ro("gap", map_of([](const State& s) -> auto& { return s.contact.gap; }))
      .def_prop_ro("solid_pressure",
                   map_of([](const State& s) -> auto& { return s.contact.pressure; }));
  module.def("friction", &friction, "surface"_a, "contact"_a, "film"_a, "contact_settings"_a,
             "settings"_a);
  module.def("density_curves", &density_curves, "surface"_a, "contacts"_a, "contact_settings"_a,
             "film_settings"_a, "settings"_a, "progress"_a.none());
  module.def("density_sentence", &sentence, "curve"_a, "densities"_a);
  module.def("fluid_film", &fluid_film, "surface"_a, "contact"_a, "film"_a, "contact_settings"_a,
             "fluid_settings"_a, "settings"_a, "progress"_a.none());
}

}  // namespace tabor::python
