#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/map.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <map>

#include "bindings.hpp"
#include "tabor/cases/records.hpp"
#include "tabor/cases/slide/slide.hpp"
#include "tabor/forming/deck.hpp"
#include "tabor/io/files/atomic_file.hpp"
#include "tabor/io/hdf5/guard.hpp"
#include "tabor/results/citations.hpp"
#include "tabor/study/friction_table.hpp"
#include "tabor/study/sweep.hpp"
#include "tabor/study/tables.hpp"
#include "values.hpp"
#include "watched.hpp"

namespace tabor::python {
namespace {

using study::Outcome;
using study::Study;

Outcome run(const Study& study, const std::filesystem::path& folder, int jobs, bool retry,
            const nb::object& progress) {
  return watched_beside(progress, [&](const Observer& observer) {
    study::SweepOptions options;
    options.jobs = jobs;
    options.retry = retry;
    options.observer = observer;
    options.command = "tabor.Study.run";
    return study::run(study, folder, options);
  });
}

/// (study files of the parts that the store lacks, warnings)
using MissingTexts = std::pair<std::vector<std::string>, std::vector<std::string>>;
MissingTexts missing_parts(const Study& study, const std::filesystem::path& folder, bool retry,
                           const nb::object& progress) {
  study::Missing missing = watched_beside(progress, [&](const Observer& observer) {
    return study::missing_parts(study, folder, retry, observer);
  });
  const std::vector<Study> parts = study::parts_of(study);
  std::vector<std::string> texts;
  texts.reserve(missing.parts.size());
  for (const std::size_t place : missing.parts) texts.push_back(study::to_toml(parts[place]));
  return {std::move(texts), std::move(missing.warnings)};
}

/// (contacts computed, failures)
std::pair<std::size_t, std::vector<std::string>> run_part(const Study& part,
                                                          const std::filesystem::path& folder,
                                                          bool retry) {
  study::PartOutcome outcome = watched_beside(nb::none(), [&](const Observer& observer) {
    engine::RunOptions options;
    options.retry = retry;
    options.observer = observer;
    return study::run_part(part, folder, options);
  });
  return {outcome.n_contacts, std::move(outcome.failures)};
}

/// Which numbers a friction table is of, and for whom.
study::FrictionTableChoice choice_of(const std::optional<std::string>& group,
                                     const std::vector<double>& densities,
                                     const std::vector<std::string>& kept_codes) {
  return {.group = group, .lubricant_densities = densities, .kept_codes = kept_codes};
}

/// (pressure [Pa], density [kg/m^2], speed [m/s], friction, standard deviation, scans)
using FrictionEntryRow =
    std::tuple<double, double, std::optional<double>, double, double, std::size_t>;
/// (rows, reasons why numbers are left out)
std::pair<std::vector<FrictionEntryRow>, std::string> friction_table(
    const std::filesystem::path& results, const study::FrictionTableChoice& choice) {
  const forming::FrictionTable table = study::friction_table(study::read_friction(results), choice);
  std::vector<FrictionEntryRow> rows;
  rows.reserve(table.entries.size());
  for (const forming::FrictionEntry& one : table.entries) {
    rows.emplace_back(one.at.mean_pressure, one.at.lubricant_density, one.at.sliding_speed,
                      one.friction, one.standard_deviation, one.n);
  }
  return {std::move(rows), forming::reasons_of(table)};
}

/// The text of a deck.
std::string deck(const std::filesystem::path& results, const study::FrictionTableChoice& choice,
                 const std::string& program, const std::string& units, int first_id) {
  const forming::Program wanted = forming::kPrograms.parse(program, "program");
  forming::FrictionTable table = study::friction_table(study::read_friction(results), choice);
  table.origin.insert(table.origin.begin(), "command: tabor.FrictionTable.deck");
  if (wanted == forming::Program::lsdyna) table = forming::complete_rows(std::move(table));
  if (wanted != forming::Program::csv) forming::require_two_pressures(table);
  return forming::deck_for(wanted, table, forming::unit_system(units), first_id);
}

void write_file(const std::filesystem::path& file, const nb::bytes& bytes) {
  io::write_file(file, std::string_view(bytes.c_str(), bytes.size()));
}

/// BibTeX of what results of these keys and these result files rest on.
std::string bibtex(const std::vector<std::string>& keys,
                   const std::vector<std::filesystem::path>& files) {
  results::ReferenceKeys wanted = results::with_software({keys.begin(), keys.end()});
  for (const std::filesystem::path& file : files) wanted.merge(results::references_in(file));
  return results::bibtex_of(results::citations(wanted));
}

std::vector<std::string> study_warnings(const Outcome& outcome) {
  std::vector<std::string> lines = outcome.warnings;
  for (const results::Finding& finding : outcome.findings) {
    lines.push_back(results::line_of(finding));
  }
  return lines;
}

/// What a run says about its numbers: (code, text, class) of each finding.
ShownWarnings findings_of(const Outcome& outcome) {
  ShownWarnings list;
  for (const results::Finding& one : outcome.findings) {
    list.emplace_back(one.code, results::statement_of(one), cases::name_of(one.kind()));
  }
  return list;
}

/// Units of the columns of studies by their keys.
std::map<std::string, std::string> column_units() {
  std::map<std::string, std::string> units;
  for (const ColumnHead& one : cases::friction_columns()) units[one.key] = one.unit;
  for (const ColumnHead& one : cases::slide_columns()) units[one.key] = one.unit;
  units.erase("");
  return units;
}

/// (warnings, failures) as results.h5 tells them.
std::pair<std::vector<std::string>, std::vector<std::string>> remarks(
    const std::filesystem::path& results) {
  study::Remarks found = study::remarks_in(results);
  return {std::move(found.warnings), std::move(found.failures)};
}

/// Texts that a root attribute of a result file holds; none without it.
std::vector<std::string> result_texts(const std::filesystem::path& file, const std::string& name) {
  return io::read_guarded(file, [&](const io::Hdf5Reader& reader) {
    return reader.has_attribute("/", name) ? reader.attribute_texts("/", name)
                                           : std::vector<std::string>();
  });
}

}  // namespace

void bind_study(nb::module_& module) {
  using namespace nb::literals;
  nb::class_<Study>(module, "Study")
      .def_ro("title", &Study::title)
      .def_ro("file", &Study::file)
      .def_prop_ro("n_cases", &Study::n_cases)
      .def_prop_ro("n_scans", [](const Study& self) { return self.scans.size(); })
      .def_prop_ro("files",
                   [](const Study& self) {
                     std::vector<std::filesystem::path> files;
                     files.reserve(self.scans.size());
                     for (const study::Scan& scan : self.scans) files.push_back(scan.file);
                     return files;
                   })
      .def_prop_ro("toml", [](const Study& self) { return study::to_toml(self); });
  nb::class_<study::FrictionTableChoice>(module, "FrictionTableChoice")
      .def(
          "__init__",
          [](study::FrictionTableChoice* self, const std::optional<std::string>& group,
             const std::vector<double>& densities, const std::vector<std::string>& kept_codes) {
            new (self) study::FrictionTableChoice(choice_of(group, densities, kept_codes));
          },
          "group"_a.none(), "densities"_a, "kept_codes"_a);
  module.def("friction_table", &friction_table, "results"_a, "choice"_a);
  module.def("deck", &deck, "results"_a, "choice"_a, "program"_a, "units"_a, "first_id"_a);
  nb::class_<Outcome>(module, "Outcome")
      .def_ro("n_cases", &Outcome::n_cases)
      .def_ro("n_done", &Outcome::n_done)
      .def_ro("n_failed", &Outcome::n_failed)
      .def_ro("n_not_converged", &Outcome::n_not_converged)
      .def_ro("n_contacts", &Outcome::n_contacts)
      .def_ro("failures", &Outcome::failures)
      .def_prop_ro("warnings", &study_warnings)
      .def_prop_ro("findings", &findings_of);
  module.def("column_units", &column_units);
  module.def(
      "read_study", [](const std::filesystem::path& file) { return study::read_study(file); },
      "file"_a);
  module.def("parse_study", &study::parse_study, "text"_a, "file"_a);
  module.def("missing_parts", &missing_parts, "study"_a, "folder"_a, "retry"_a,
             "progress"_a.none());
  module.def("run_part", &run_part, "part"_a, "folder"_a, "retry"_a);
  module.def("write_file", &write_file, "file"_a, "bytes"_a);
  module.def("bibtex", &bibtex, "keys"_a, "files"_a);
  module.def("whole_bibtex", [] { return results::bibtex_of(results::citations()); });
  module.def("result_remarks", &remarks, "file"_a);
  module.def("result_texts", &result_texts, "file"_a, "name"_a);
  module.def("run_study", &run, "study"_a, "folder"_a, "jobs"_a, "retry"_a, "progress"_a.none());
}

}  // namespace tabor::python
