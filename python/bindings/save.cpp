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
using results::FieldsFile;
using topography::Topography;

/// The file, and what was saved into it.
struct Target {
  std::filesystem::path file;
  results::FieldsOptions options;
  std::string sha256;  ///< of the scan file
};

FieldsFile open(const Target& target, const Topography& surface, const io::Json& settings,
                const std::vector<std::string>& methods) {
  return FieldsFile(target.file, target.options,
                    {"tabor.save", results::toml_of(settings), methods}, surface,
                    {surface.source, target.sha256});
}

/// Without the maps, which need not be copied.
ContactRecord numbers_of(const ContactRecord& record) {
  return {.surface = record.surface,
          .summary = record.summary,
          .convergence = record.convergence,
          .fft_seconds = record.fft_seconds,
          .seconds = record.seconds,
          .peak_memory = record.peak_memory,
          .statistics = {},
          .warnings = record.warnings,
          .references = record.references,
          .state = {}};
}
const FilmRecord& numbers_of(const FilmRecord& record) { return record; }
const FrictionRecord& numbers_of(const FrictionRecord& record) { return record; }

/// Adds the states of records that lie one beside the other, and their warnings.
template <typename Record, typename Fields>
void add_states(const std::vector<const Record*>& records, const Columns<Record>& columns,
                const Fields& fields_at, const Warnings& more, FieldsFile& file) {
  std::vector<results::Case> cases;
  cases.reserve(records.size());
  for (std::size_t i = 0; i < records.size(); ++i) {
    Record shown = numbers_of(*records[i]);
    Warnings warnings = more;
    add(shown.warnings, warnings);
    shown.warnings = std::move(warnings);
    file.add_state(i, cells_of(columns, shown, cases::media::kObject), fields_at(i));
    cases.push_back(results::case_of(shown));
  }
  std::vector<results::Finding> findings = results::findings_of(cases);
  results::spell(spelled, findings);
  file.commit(findings);
}

void save_contacts(const Target& target, const Topography& surface, const CaseSettings& settings,
                   const std::vector<const ContactRecord*>& contacts) {
  watched(nb::none(), [&](const Observer&) {
    FieldsFile file = open(target, surface, results::settings_json(settings.contact),
                           cases::references_of(settings.contact));
    add_states(
        contacts, cases::contact_columns(),
        [&](std::size_t i) { return results::fields_of(*contacts[i]); }, {}, file);
    return true;
  });
}

void save_films(const Target& target, const Topography& surface, const CaseSettings& settings,
                const std::vector<const FilmRecord*>& films) {
  watched(nb::none(), [&](const Observer&) {
    FieldsFile file = open(target, surface, results::settings_json(settings.film),
                           cases::references_of(settings.film));
    add_states(
        films, cases::film_columns(), [&](std::size_t i) { return results::fields_of(*films[i]); },
        cases::of_surface(surface), file);
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

/// Lists of one length; `fluids` may be empty.
void save_frictions(const Target& target, const Topography& surface, const CaseSettings& settings,
                    const std::vector<const FrictionRecord*>& frictions,
                    const std::vector<const ContactRecord*>& contacts,
                    const std::vector<const FilmRecord*>& films,
                    const std::vector<const FluidRecord*>& fluids, const nb::object& progress) {
  watched(progress, [&](const Observer& observer) {
    FieldsFile file =
        open(target, surface, results::settings_json(settings), cases::references_of(settings));
    add_curves(surface, settings, frictions, contacts, observer, file);
    const auto fields_at = [&](std::size_t i) {
      return results::fields_of(*contacts[i], *films[i], fluids.empty() ? nullptr : fluids[i]);
    };
    add_states(frictions, cases::friction_columns(), fields_at, {}, file);
    return true;
  });
}

}  // namespace

void bind_save(nb::module_& module) {
  using namespace nb::literals;
  nb::class_<Target>(module, "Target")
      .def(
          "__init__",
          [](Target* self, const std::filesystem::path& file, const std::string& fields,
             bool doubles, const std::string& sha256) {
            new (self) Target{file, {results::kFields.parse(fields, "fields"), doubles}, sha256};
          },
          "file"_a, "fields"_a, "doubles"_a, "sha256"_a);
  nb::class_<CaseSettings>(module, "CaseSettings")
      .def(nb::init<>())
      .def_rw("contact", &CaseSettings::contact)
      .def_rw("film", &CaseSettings::film)
      .def_rw("fluid", &CaseSettings::fluid)
      .def_rw("friction", &CaseSettings::friction);
  module.def("save_contacts", &save_contacts, "target"_a, "surface"_a, "settings"_a, "contacts"_a);
  module.def("save_films", &save_films, "target"_a, "surface"_a, "settings"_a, "films"_a);
  module.def("save_frictions", &save_frictions, "target"_a, "surface"_a, "settings"_a,
             "frictions"_a, "contacts"_a, "films"_a, "fluids"_a, "progress"_a.none());
}

}  // namespace tabor::python
