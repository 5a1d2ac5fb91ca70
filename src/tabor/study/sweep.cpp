#include "tabor/study/sweep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <utility>

#include "tabor/study/engine.hpp"
#include "tabor/study/friction_jobs.hpp"
#include "tabor/study/store.hpp"
#include "tabor/study/tables.hpp"

namespace tabor::study {
namespace {

void count_rows(const std::vector<Row>& rows, Outcome& outcome) {
  outcome.n_done = rows.size();
  outcome.findings = findings_in(rows);
  for (const Row& row : rows) {
    outcome.n_failed += row.failed() ? 1 : 0;
    outcome.n_not_converged += !row.failed() && !row.converged ? 1 : 0;
    if (row.failed()) {
      outcome.failures.push_back(
          fmt::format("{} {} Pa: {}", row.scan, row.mean_pressure, row.error));
    }
  }
  const auto last = std::unique(outcome.failures.begin(), outcome.failures.end());
  outcome.failures.erase(last, outcome.failures.end());
}

void count_computed(const Report& report, Outcome& outcome) {
  outcome.n_surfaces = report.computed("surface");
  outcome.n_contacts = report.computed("contact");
  outcome.n_films = report.computed("film");
  outcome.n_fluids = report.computed("fluid");
  outcome.n_rows = report.computed("case");
  outcome.warnings.insert(outcome.warnings.end(), report.warnings.begin(), report.warnings.end());
}

/// They may be averaged as if they were two measurements.
bool count_twice(const Study& study, const std::vector<ScanTasks>& tasks, std::size_t i,
                 std::size_t j) {
  return tasks[i].sha256 == tasks[j].sha256 && study.scans[i].group == study.scans[j].group;
}

void warn_about_copies(const Study& study, const std::vector<ScanTasks>& tasks,
                       std::vector<std::string>& warnings) {
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (count_twice(study, tasks, i, j)) {
        warnings.push_back(
            fmt::format("{} and {} hold the same bytes; where one average has both, its error is "
                        "too small",
                        study.scans[j].label, study.scans[i].label));
      }
    }
  }
}

}  // namespace

Outcome run(const Study& study, const std::filesystem::path& directory,
            const SweepOptions& options) {
  const Store store(directory, options.shard ? Store::Use::shared : Store::Use::alone);
  Outcome outcome;
  outcome.n_cases = study.n_cases();
  const std::vector<ScanTasks> tasks = tasks_of(study, options.observer);
  warn_about_copies(study, tasks, outcome.warnings);
  const Report report = run_jobs(friction_jobs(store, study, tasks), &store, options);
  count_computed(report, outcome);
  std::exception_ptr error = report.ended_by;
  try {
    // One shard at a time: whoever comes last has seen every row.
    const auto lock = store.lock("results", [] {});
    StudyTables tables = tables_of(store, study, tasks);
    write_tables(store, study, tasks, tables, options.command);
    count_rows(tables.rows, outcome);
    outcome.averages = std::move(tables.averages);
    outcome.density_curves = std::move(tables.averaged);
  } catch (...) {
    error = error ? error : std::current_exception();
  }
  if (error) std::rethrow_exception(error);
  return outcome;
}

}  // namespace tabor::study
