#include "tabor/study/sweep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <utility>

#include "tabor/engine/engine.hpp"
#include "tabor/engine/store.hpp"
#include "tabor/study/friction_graph.hpp"
#include "tabor/study/friction_jobs.hpp"
#include "tabor/study/slides.hpp"
#include "tabor/study/tables.hpp"

namespace tabor::study {
namespace {

void count_rows(const std::vector<Row>& rows, const StudySlides& slides, Outcome& outcome) {
  outcome.n_done = rows.size();
  outcome.findings = findings_in(rows, slides.warnings);
  for (const Row& row : rows) {
    outcome.n_failed += row.failed() ? 1 : 0;
    outcome.n_not_converged += !row.failed() && !row.converged ? 1 : 0;
  }
  outcome.failures = failures_in(rows);
  outcome.n_failed_slides = slides.failures.size();
  outcome.failures.insert(outcome.failures.end(), slides.failures.begin(), slides.failures.end());
}

void count_computed(const engine::Report& report, Outcome& outcome) {
  const auto computed = [&report](FrictionJob job) { return report.computed(kind_of(job)); };
  outcome.n_surfaces = report.computed("surface");
  outcome.n_contacts = computed(FrictionJob::contact);
  outcome.n_films = computed(FrictionJob::film);
  outcome.n_trapped = computed(FrictionJob::trapped);
  outcome.n_fluids = computed(FrictionJob::fluid);
  outcome.n_rows = computed(FrictionJob::friction);
  outcome.n_slides = report.computed(kSlideKind);
  outcome.warnings.insert(outcome.warnings.end(), report.warnings.begin(), report.warnings.end());
}

/// They may be averaged as if they were two measurements.
bool count_twice(const Study& study, const std::vector<ScanTasks>& tasks, std::size_t i,
                 std::size_t j) {
  return tasks[i].sha256 == tasks[j].sha256 && study.scans[i].group == study.scans[j].group;
}

/// A warning for each scan that is there twice.
std::vector<std::string> copies_in(const Study& study, const std::vector<ScanTasks>& tasks) {
  std::vector<std::string> warnings;
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (count_twice(study, tasks, i, j)) {
        warnings.push_back(
            fmt::format("{} and {} are the same file. The error of an average over both is too "
                        "small",
                        study.scans[j].label, study.scans[i].label));
      }
    }
  }
  return warnings;
}

}  // namespace

Outcome run(const Study& study, const std::filesystem::path& directory,
            const SweepOptions& options) {
  const engine::Store store(directory,
                            options.shard ? engine::Store::Use::shared : engine::Store::Use::alone);
  Outcome outcome;
  outcome.n_cases = study.n_cases();
  const std::vector<ScanTasks> tasks = tasks_of(study, options.observer);
  outcome.warnings = copies_in(study, tasks);
  const engine::Report report =
      engine::run_jobs(friction_jobs(store, study, tasks), &store, options);
  count_computed(report, outcome);
  std::exception_ptr error = report.ended_by;
  try {
    // One shard at a time: whoever comes last has seen every row.
    const auto lock = store.lock("results", [] {});
    StudyTables tables = tables_of(store, study, tasks);
    tables.warnings = outcome.warnings;
    write_tables(store, study, tasks, tables, options.command);
    count_rows(tables.rows, tables.slides, outcome);
    outcome.slides = std::move(tables.slides.rows);
    outcome.averages = std::move(tables.averages);
    outcome.density_curves = std::move(tables.averaged);
  } catch (...) {
    error = error ? error : std::current_exception();
  }
  if (error) std::rethrow_exception(error);
  return outcome;
}

}  // namespace tabor::study
