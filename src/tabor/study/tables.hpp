#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tabor/results/findings.hpp"
#include "tabor/study/averages.hpp"
#include "tabor/study/density_curves.hpp"
#include "tabor/study/record.hpp"
#include "tabor/study/slides.hpp"

// Writes the result tables of a study (results.csv, averages.csv, results.h5) from its store.
namespace tabor::study {

/// Returns the rows that the store holds so far, in the order scan, pressure, density of the study.
/// Damaged ones are left out.
std::vector<Row> rows_in(const engine::Store& store, const std::vector<ScanTasks>& tasks);

/// Returns the warnings about the numbers of these rows, and of slides, each once with its cases.
std::vector<results::Finding> findings_in(const std::vector<Row>& rows,
                                          const std::vector<results::Case>& of_slides = {});

/// Returns one line for each scan and reason of a failure, "SCAN: WHY" where it failed under all
/// pressures, else "SCAN under 2 MPa, 7 MPa: WHY".
std::vector<std::string> failures_in(const std::vector<Row>& rows);

/// Warnings and failures of a study, as results.h5 stores them.
struct Remarks {
  std::vector<std::string> warnings;
  std::vector<std::string> failures;
};
/// Reads the remarks of a results.h5. Throws InputError for any other file.
Remarks remarks_in(const std::filesystem::path& results);

/// Return the contents of results.csv and averages.csv; a value that does not exist is an empty
/// cell. Where a tool presses or the oil flows they have more columns.
std::string results_csv(const std::vector<Row>& rows,
                        const cases::FrictionParts& parts = {
                            .trapped = false, .fluid = false, .tool = false});
std::string averages_csv(const std::vector<Average>& averages,
                         const cases::FrictionParts& parts = {
                             .trapped = false, .fluid = false, .tool = false});

/// Content of the tables of a study.
struct StudyTables {
  std::vector<Row> rows;
  std::vector<Average> averages;     ///< of the rows
  std::vector<ScanCurve> curves;     ///< friction against density
  std::vector<GroupCurve> averaged;  ///< of the curves
  StudySlides slides = {};
  /// About the scans that were chosen; results.h5 names them before those of the rows.
  std::vector<std::string> warnings = {};
};

/// Reads all that the store holds so far.
StudyTables tables_of(const engine::Store& store, const Study& study,
                      const std::vector<ScanTasks>& tasks);

/// Writes results.csv, averages.csv, density_curves.csv and slides.csv (where there are such) and
/// results.h5
/// into the study's folder from what the store holds. `command` is the command line that asked for
/// it. Throws OutputError.
void write_tables(const engine::Store& store, const Study& study,
                  const std::vector<ScanTasks>& tasks, const StudyTables& tables,
                  const std::string& command);

}  // namespace tabor::study
