#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <algorithm>

#include "tabor/cases/states.hpp"
#include "tabor/cases/warnings.hpp"
#include "tabor/results/fields_file.hpp"
#include "tabor/study/curves_file.hpp"
#include "values.hpp"
#include "watched.hpp"

namespace tabor::python {
namespace {

using cases::CaseSettings;
using cases::ContactRecord;
using cases::FilmRecord;
using cases::FluidRecord;
using cases::FrictionRecord;
using cases::TrappedRecord;
using results::FieldsFile;
using results::FieldsTarget;
using topography::Topography;

/// Writes the warnings of all states and completes the file.
void commit(const std::vector<results::Case>& cases, FieldsFile& file) {
  std::vector<results::Finding> findings = results::findings_of(cases);
  results::spell(spelled, findings);
  file.commit(findings);
}

FieldsTarget of(FieldsTarget target, const Topography& surface) {
  target.origin.path = surface.source;
  return target;
}

void save_contacts(const FieldsTarget& target, const Topography& surface,
                   const CaseSettings& settings,
                   const std::vector<const ContactRecord*>& contacts) {
  watched(nb::none(), [&](const Observer&) {
    FieldsFile file(of(target, surface), surface, settings.contact);
    std::vector<results::Case> cases;
    cases.reserve(contacts.size());
    for (const ContactRecord* one : contacts) {
      file.add(cases.size(), *one);
      cases.push_back(results::case_of(*one));
    }
    commit(cases, file);
    return true;
  });
}

void save_films(const FieldsTarget& target, const Topography& surface, const CaseSettings& settings,
                const std::vector<const FilmRecord*>& films) {
  watched(nb::none(), [&](const Observer&) {
    FieldsFile file(of(target, surface), surface, settings.film);
    const Warnings about_surface = cases::of_surface(surface);
    std::vector<results::Case> cases;
    cases.reserve(films.size());
    for (const FilmRecord* film : films) {
      FilmRecord one = *film;
      one.warnings = cases::joined(about_surface, one.warnings);
      file.add(cases.size(), one);
      cases.push_back(results::case_of(one));
    }
    commit(cases, file);
    return true;
  });
}

/// Friction against density of each contact, once.
void add_curves(const Topography& surface, const CaseSettings& settings,
                const std::vector<const FrictionRecord*>& frictions,
                const std::vector<const ContactRecord*>& contacts, const Observer& observer,
                FieldsFile& file) {
  if (!cases::has_density_curve(settings)) return;
  std::vector<const ContactRecord*> seen;
  std::vector<cases::Touching> touching;
  for (const ContactRecord* one : contacts) {
    if (std::find(seen.begin(), seen.end(), one) != seen.end()) continue;
    seen.push_back(one);
    touching.push_back(cases::touching_of(*one));
  }
  std::vector<FrictionRecord> records;
  records.reserve(frictions.size());
  for (const FrictionRecord* one : frictions) records.push_back(*one);
  study::write_curves(cases::density_curves(surface, touching, settings, observer), surface.source,
                      records, file);
}

/// The records of one kind of oil; null where there are none.
template <typename Record>
const Record* at(const std::vector<const Record*>& records, std::size_t i) {
  return records.empty() ? nullptr : records[i];
}

/// Lists of one length; `trapped` and `fluids` may be empty.
void save_frictions(const FieldsTarget& target, const Topography& surface,
                    const CaseSettings& settings,
                    const std::vector<const FrictionRecord*>& frictions,
                    const std::vector<const ContactRecord*>& contacts,
                    const std::vector<const FilmRecord*>& films,
                    const std::vector<const TrappedRecord*>& trapped,
                    const std::vector<const FluidRecord*>& fluids, const nb::object& progress) {
  watched(progress, [&](const Observer& observer) {
    FieldsFile file(of(target, surface), surface, settings);
    add_curves(surface, settings, frictions, contacts, observer, file);
    std::vector<results::Case> cases;
    cases.reserve(frictions.size());
    for (std::size_t i = 0; i < frictions.size(); ++i) {
      file.add(i, *frictions[i], *contacts[i], {*films[i], at(trapped, i), at(fluids, i)});
      cases.push_back(results::case_of(*frictions[i]));
    }
    commit(cases, file);
    return true;
  });
}

}  // namespace

void bind_save(nb::module_& module) {
  using namespace nb::literals;
  nb::class_<FieldsTarget>(module, "Target")
      .def(
          "__init__",
          [](FieldsTarget* self, const std::filesystem::path& file, const std::string& fields,
             bool doubles, const std::string& sha256) {
            new (self) FieldsTarget{file,
                                    {results::kFields.parse(fields, "fields"), doubles},
                                    "tabor.save",
                                    {"", sha256}};
          },
          "file"_a, "fields"_a, "doubles"_a, "sha256"_a);
  nb::class_<CaseSettings>(module, "CaseSettings")
      .def(nb::init<>())
      .def_rw("contact", &CaseSettings::contact)
      .def_rw("film", &CaseSettings::film)
      .def_rw("trapped", &CaseSettings::trapped)
      .def_rw("fluid", &CaseSettings::fluid)
      .def_rw("friction", &CaseSettings::friction);
  module.def("save_contacts", &save_contacts, "target"_a, "surface"_a, "settings"_a, "contacts"_a);
  module.def("save_films", &save_films, "target"_a, "surface"_a, "settings"_a, "films"_a);
  module.def("save_frictions", &save_frictions, "target"_a, "surface"_a, "settings"_a,
             "frictions"_a, "contacts"_a, "films"_a, "trapped"_a, "fluids"_a, "progress"_a.none());
}

}  // namespace tabor::python
