#pragma once

#include <string>
#include <vector>

#include "tabor/analysis/findings.hpp"
#include "tabor/study/averages.hpp"
#include "tabor/study/density_curves.hpp"
#include "tabor/study/record.hpp"

namespace tabor::study {

/// The rows the store holds so far, in the order scan, pressure, density of the study. Damaged ones
/// are left out.
std::vector<Row> rows_in(const Store& store, const std::vector<ScanTasks>& tasks);

/// What must be said of the numbers of these rows, each once with its cases.
std::vector<analysis::Finding> findings_in(const std::vector<Row>& rows);

/// Contents of results.csv and averages.csv; a value that does not exist is an empty cell. Where
/// the oil of the study flows they have more columns.
std::string results_csv(const std::vector<Row>& rows, bool oil_flows = false);
std::string averages_csv(const std::vector<Average>& averages, bool oil_flows = false);

/// What the tables of a study show.
struct StudyTables {
  std::vector<Row> rows;
  std::vector<Average> averages;     ///< of the rows
  std::vector<ScanCurve> curves;     ///< friction against density
  std::vector<GroupCurve> averaged;  ///< of the curves
};

/// All that the store holds so far.
StudyTables tables_of(const Store& store, const Study& study, const std::vector<ScanTasks>& tasks);

/// Writes results.csv, averages.csv, density_curves.csv (unless no curve is there) and results.h5
/// into the study's folder from what the store holds. `command` is the command line that asked for
/// it. Throws OutputError.
void write_tables(const Store& store, const Study& study, const std::vector<ScanTasks>& tasks,
                  const StudyTables& tables, const std::string& command);

}  // namespace tabor::study
