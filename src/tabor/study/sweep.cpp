#include "tabor/study/sweep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <exception>

#include "tabor/study/sweep_workers.hpp"
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

void warn_about_copies(const Study& study, const std::vector<ScanUnits>& units,
                       std::vector<std::string>& warnings) {
  for (std::size_t i = 0; i < units.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (units[i].sha256 == units[j].sha256) {
        warnings.push_back(
            fmt::format("{} and {} hold the same bytes; if both are in one average, its error is "
                        "too small",
                        study.scans[j].label, study.scans[i].label));
      }
    }
  }
}

}  // namespace

Outcome run(const Study& study, const std::filesystem::path& directory,
            const SweepOptions& options) {
  const Stopwatch since_start;
  const Store store(directory, options.shard ? Store::Use::shared : Store::Use::alone);
  Outcome outcome;
  outcome.n_cases = study.n_cases();
  const std::vector<ScanUnits> units = units_of(study, options.observer);
  warn_about_copies(study, units, outcome.warnings);
  const auto plans = plan(store, study, units, options.shard.value_or(Shard{}), options.retry,
                          outcome.warnings, options.observer);
  std::exception_ptr error;
  try {
    compute_missing(store, study, units, plans, options, since_start, outcome);
  } catch (...) {
    error = std::current_exception();
  }
  try {
    // One shard at a time: whoever comes last has seen every row.
    const auto lock = store.lock("results", [] {});
    const std::vector<Row> rows = rows_in(store, units);
    write_tables(store, study, units, rows, options.command);
    count_rows(rows, outcome);
  } catch (...) {
    error = error ? error : std::current_exception();
  }
  if (error) {
    std::rethrow_exception(error);
  }
  return outcome;
}

}  // namespace tabor::study
