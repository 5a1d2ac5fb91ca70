#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include "parameters.hpp"
#include "records.hpp"
#include "tabor/cases/belonging.hpp"
#include "tabor/cases/density_curve.hpp"
#include "tabor/cases/states.hpp"
#include "tabor/friction/wet_contact.hpp"
#include "tabor/results/density_answer.hpp"
#include "tabor/topography/topography.hpp"
#include "watched.hpp"

namespace tabor::python {
namespace {

using cases::ContactRecord;
using cases::ContactSettings;
using cases::DensityCurve;
using cases::FilmRecord;
using cases::FluidRecord;
using cases::FluidSettings;
using cases::FrictionRecord;
using cases::FrictionSettings;
using cases::TrappedRecord;
using cases::TrappedSettings;
using topography::Topography;

/// What a friction is computed from.
struct Pair {
  const Topography& surface;
  const ContactRecord& contact;
  const FilmRecord& film;
};

FrictionRecord friction_of(const Pair& pair, const cases::Oil& oil, const ContactSettings& contact,
                           const FrictionSettings& settings) {
  const Mask mask = contact::contact_mask(pair.contact.state);
  return cases::friction_state(pair.contact, {mask, pair.contact.state.gap, pair.surface.grid}, oil,
                               contact, settings);
}

/// Contact pixels that stand in oil as it was deposited.
OwnMap<Mask> wet_contact(const ContactRecord& contact, const FilmRecord& film,
                         const FrictionSettings& settings) {
  return handed_over(tabor::friction::wet_contact(contact::contact_mask(contact.state),
                                                  film.film.thickness, settings.dry_below));
}

/// Trapped oil carries load, the oil flows, a tool presses.
using Parts = std::tuple<bool, bool, bool>;
/// (numbers, parts, area, warnings, references)
using FrictionState =
    std::tuple<nb::dict, Parts, std::string, WarningTexts, std::vector<std::string>>;

FrictionState saved_friction(const FrictionRecord& one) {
  const cases::FrictionParts parts = cases::parts_of(one);
  return {saved(cases::friction_columns(parts), one),
          {parts.trapped, parts.fluid, parts.tool},
          std::string(tabor::friction::kAreas.of(one.area)),
          python::texts_of(one.warnings),
          one.references};
}

void restore_friction(FrictionRecord& self, const FrictionState& saved) {
  auto& one = *new (&self) FrictionRecord();
  cases::FrictionParts parts;
  std::tie(parts.trapped, parts.fluid, parts.tool) = std::get<1>(saved);
  if (parts.trapped) one.trapped.emplace();
  if (parts.fluid) one.fluid.emplace();
  if (parts.tool) one.tool.emplace();
  restore(cases::friction_columns(parts), std::get<0>(saved), one);
  one.area = tabor::friction::kAreas.parse(std::get<2>(saved), "area");
  one.warnings = warnings_of(std::get<3>(saved));
  one.references = std::get<4>(saved);
}

/// (numbers, (status, digest of the surface), warnings, references, maps)
using TrappedState = std::tuple<nb::dict, std::pair<int, std::uint64_t>, WarningTexts,
                                std::vector<std::string>, MapArgument, MapArgument, MapArgument>;

nb::object saved_trapped(nb::handle_t<TrappedRecord> self) {
  const auto& one = nb::cast<const TrappedRecord&>(self);
  return nb::cast(std::make_tuple(
      saved(cases::trapped_columns(), one),
      std::make_pair(static_cast<int>(one.convergence.status), one.surface),
      python::texts_of(one.warnings), one.references, view_of(one.state.liquid_pressure, self),
      view_of(one.state.contact.pressure, self), view_of(one.state.contact.gap, self)));
}

void restore_trapped(TrappedRecord& self, const TrappedState& saved) {
  auto& one = *new (&self) TrappedRecord();
  restore(cases::trapped_columns(), std::get<0>(saved), one);
  one.convergence.status = static_cast<Status>(std::get<1>(saved).first);
  one.surface = std::get<1>(saved).second;
  one.warnings = warnings_of(std::get<2>(saved));
  one.references = std::get<3>(saved);
  one.state.liquid_pressure = field_of(std::get<4>(saved));
  one.state.contact.pressure = field_of(std::get<5>(saved));
  one.state.contact.gap = field_of(std::get<6>(saved));
}

/// (numbers, speed [m/s], (status, digest of the surface), warnings, references, maps)
using FluidState =
    std::tuple<nb::dict, double, std::pair<int, std::uint64_t>, WarningTexts,
               std::vector<std::string>, MapArgument, MapArgument, MapArgument, MapArgument>;

nb::object saved_fluid(nb::handle_t<FluidRecord> self) {
  const auto& one = nb::cast<const FluidRecord&>(self);
  const tabor::friction::FluidFilmState& state = one.state;
  return nb::cast(
      std::make_tuple(saved(cases::fluid_columns(), one), one.sliding_speed,
                      std::make_pair(static_cast<int>(one.summary.convergence.status), one.surface),
                      python::texts_of(one.warnings), one.references,
                      view_of(state.film.pressure, self), view_of(state.film.fill, self),
                      view_of(state.contact.gap, self), view_of(state.contact.pressure, self)));
}

void restore_fluid(FluidRecord& self, const FluidState& saved) {
  auto& one = *new (&self) FluidRecord();
  restore(cases::fluid_columns(), std::get<0>(saved), one);
  one.sliding_speed = std::get<1>(saved);
  one.summary.convergence.status = static_cast<Status>(std::get<2>(saved).first);
  one.surface = std::get<2>(saved).second;
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
  check(cases::objection(settings, argument_of, contact_settings.material));
  const Pair pair{surface, contact, film};
  cases::require_contact_of(surface, contact.surface);
  cases::require_one_surface(contact, film);
  return watched(nb::none(), [&](const Observer&) {
    return friction_of(pair, {film}, contact_settings, settings);
  });
}

/// The trapped oil, and friction with it.
std::pair<TrappedRecord, FrictionRecord> trapped_oil(
    const Topography& surface, const ContactRecord& contact, const FilmRecord& film,
    const ContactSettings& contact_settings, const TrappedSettings& trapped_settings,
    const FrictionSettings& settings, const nb::object& progress) {
  const cases::CaseSettings all{
      .contact = contact_settings, .trapped = trapped_settings, .friction = settings};
  check(cases::objection_to_trapped(all, argument_of));
  check(cases::objection(settings, argument_of, contact_settings.material));
  const Pair pair{surface, contact, film};
  return watched(progress, [&](const Observer& observer) {
    const auto elasticity = cases::make_operator(contact_settings, surface.grid);
    TrappedRecord trapped =
        cases::trapped_state(*elasticity, surface, contact, film, all, observer);
    FrictionRecord record = friction_of(pair, {film, &trapped}, contact_settings, settings);
    return std::make_pair(std::move(trapped), std::move(record));
  });
}

/// The flowing film, and friction with it.
std::pair<FluidRecord, FrictionRecord> fluid_film(
    const Topography& surface, const ContactRecord& contact, const FilmRecord& film,
    const ContactSettings& contact_settings, const FluidSettings& fluid_settings,
    const FrictionSettings& settings, const nb::object& progress) {
  check(cases::objection(fluid_settings, contact_settings, argument_of));
  check(cases::objection(settings, argument_of, contact_settings.material));
  const Pair pair{surface, contact, film};
  cases::require_contact_of(surface, contact.surface);
  cases::require_one_surface(contact, film);
  return watched(progress, [&](const Observer& observer) {
    const auto elasticity = cases::make_operator(contact_settings, surface.grid);
    FluidRecord flowing = cases::fluid_state(*elasticity, surface, contact, film, contact_settings,
                                             fluid_settings, observer);
    FrictionRecord record =
        friction_of(pair, {film, nullptr, &flowing}, contact_settings, settings);
    return std::make_pair(std::move(flowing), std::move(record));
  });
}

using Numbers = std::vector<double>;
/// (pressure [Pa], dry friction, densities [kg/m^2], wet shares, friction, plateau)
/// Numbers of the plateau: its ends, its dry share, and the densities beside it that the curve has.
using PlateauRow = std::tuple<double, double, double, std::optional<double>, std::optional<double>>;
using CurveRow = std::tuple<double, double, Numbers, Numbers, Numbers, std::optional<PlateauRow>>;
CurveRow row_of(const DensityCurve& curve) {
  std::optional<PlateauRow> plateau;
  if (curve.plateau) {
    const results::BesidePlateau beside = results::beside_plateau(curve);
    plateau.emplace(curve.plateau->first, curve.plateau->last, curve.plateau->value, beside.below,
                    beside.beyond);
  }
  return {curve.mean_pressure,     curve.friction_dry,        curve.lubricant_densities,
          curve.lubricated_shares, curve.friction_lubricated, plateau};
}

DensityCurve curve_of(const CurveRow& row) {
  DensityCurve curve;
  std::tie(curve.mean_pressure, curve.friction_dry, curve.lubricant_densities,
           curve.lubricated_shares, curve.friction_lubricated, std::ignore) = row;
  if (const auto& plateau = std::get<5>(row)) {
    curve.plateau =
        cases::Plateau{std::get<0>(*plateau), std::get<1>(*plateau), std::get<2>(*plateau)};
  }
  return curve;
}

/// One for each of these contacts with the surface.
std::vector<CurveRow> density_curves(const Topography& surface,
                                     const std::vector<const ContactRecord*>& contacts,
                                     const ContactSettings& contact,
                                     const cases::FilmSettings& film,
                                     const FrictionSettings& friction, const nb::object& progress) {
  check(cases::objection(film));
  check(cases::objection(friction, argument_of, contact.material));
  const auto curves = watched(progress, [&](const Observer& observer) {
    std::vector<cases::Touching> touching;
    touching.reserve(contacts.size());
    for (const ContactRecord* one : contacts) touching.push_back(cases::touching_of(*one));
    const cases::CaseSettings settings{.contact = contact, .film = film, .friction = friction};
    return cases::density_curves(surface, touching, settings, observer);
  });
  std::vector<CurveRow> rows;
  rows.reserve(curves.size());
  for (const DensityCurve& curve : curves) rows.push_back(row_of(curve));
  return rows;
}

/// Throws InputError for an oil that does not exist.
void check_lubricant(const FluidSettings& settings) {
  check(objection_to_bounds(cases::fluid_parameters(), settings));
  tabor::friction::lubricant_of(settings.oil());
}

/// Throws InputError for settings that say something of trapped oil where none is.
void check_trapped(const TrappedSettings& settings) {
  check(cases::objection_to_trapped({.trapped = settings}, argument_of));
}

/// Returns the sentence of densities [kg/m^2] with wet shares, or those of the curve.
std::string sentence(const CurveRow& row,
                     const std::vector<std::pair<double, std::optional<double>>>& densities) {
  const DensityCurve curve = curve_of(row);
  std::vector<results::AskedDensity> asked;
  for (const auto& [density, share] : densities) {
    if (density > 0) {
      asked.push_back({density, share ? *share : results::lubricated_share_at(curve, density)});
    }
  }
  return results::sentence_of(curve, asked);
}

void bind_settings(nb::module_& module) {
  nb::class_<FrictionSettings> friction_settings(module, "FrictionSettings");
  friction_settings.def(nb::init<>());
  bind_parameters(friction_settings, cases::friction_parameters());
  nb::class_<TrappedSettings> trapped_settings(module, "TrappedSettings");
  trapped_settings.def(nb::init<>());
  bind_parameters(trapped_settings, cases::trapped_parameters());
  nb::class_<FluidSettings> fluid_settings(module, "FluidSettings");
  fluid_settings.def("__init__", [](FluidSettings* self) {
    new (self) FluidSettings{.fluid = cases::Fluid::reynolds};
  });
  bind_parameters(fluid_settings, cases::fluid_parameters());
}

/// Access to a map of trapped or flowing oil as a property.
template <typename Record, typename Access>
auto map_of(Access access) {
  return [access](nb::handle_t<Record> self) {
    return view_of(access(nb::cast<const Record&>(self).state), self);
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
                     return dict_of(cells_of(cases::friction_columns(), self));
                   })
      .def_prop_ro("warnings", [](const FrictionRecord& self) { return shown(self.warnings); })
      .def_ro("references", &FrictionRecord::references);
  nb::class_<TrappedRecord>(module, "TrappedRecord")
      .def("__getstate__", &saved_trapped)
      .def("__setstate__", &restore_trapped)
      .def_prop_ro("liquid_pressure", map_of<TrappedRecord>([
                   ](const contact::TrappedState& s) -> auto& { return s.liquid_pressure; }))
      .def_prop_ro("pressure", map_of<TrappedRecord>([](const contact::TrappedState& s) -> auto& {
                     return s.contact.pressure;
                   }))
      .def_prop_ro("gap", map_of<TrappedRecord>([](const contact::TrappedState& s) -> auto& {
                     return s.contact.gap;
                   }));
  nb::class_<FluidRecord>(module, "FluidRecord")
      .def("__getstate__", &saved_fluid)
      .def("__setstate__", &restore_fluid)
      .def_prop_ro("pressure",
                   map_of<FluidRecord>([](const State& s) -> auto& { return s.film.pressure; }))
      .def_prop_ro("fill", map_of<FluidRecord>([](const State& s) -> auto& { return s.film.fill; }))
      .def_prop_ro("gap",
                   map_of<FluidRecord>([](const State& s) -> auto& { return s.contact.gap; }))
      .def_prop_ro("solid_pressure",
                   map_of<FluidRecord>([](const State& s) -> auto& { return s.contact.pressure; }));
  module.def("friction", &friction, "surface"_a, "contact"_a, "film"_a, "contact_settings"_a,
             "settings"_a);
  module.def("density_curves", &density_curves, "surface"_a, "contacts"_a, "contact_settings"_a,
             "film_settings"_a, "settings"_a, "progress"_a.none());
  module.def("trapped_oil", &trapped_oil, "surface"_a, "contact"_a, "film"_a, "contact_settings"_a,
             "trapped_settings"_a, "settings"_a, "progress"_a.none());
  module.def("wet_contact", &wet_contact, "contact"_a, "film"_a, "settings"_a);
  module.def("check_trapped", &check_trapped, "settings"_a);
  module.def("check_lubricant", &check_lubricant, "settings"_a);
  module.def("density_sentence", &sentence, "curve"_a, "densities"_a);
  module.def("fluid_film", &fluid_film, "surface"_a, "contact"_a, "film"_a, "contact_settings"_a,
             "fluid_settings"_a, "settings"_a, "progress"_a.none());
}

}  // namespace tabor::python
