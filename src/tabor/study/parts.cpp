#include <algorithm>
#include <set>
#include <utility>

#include "tabor/engine/engine.hpp"
#include "tabor/engine/plan.hpp"
#include "tabor/engine/store.hpp"
#include "tabor/study/friction_graph.hpp"
#include "tabor/study/friction_jobs.hpp"
#include "tabor/study/sweep.hpp"

// A study in parts for many processes.
namespace tabor::study {
namespace {

/// For each part, the place of its pressure in the list of its scan.
std::vector<std::size_t> places_of_pressures(const Study& study) {
  std::vector<std::size_t> places;
  for (const Scan& scan : study.scans) {
    const std::size_t n = study.of(scan).settings.mean_pressures.size();
    for (std::size_t i = 0; i < n; ++i) places.push_back(i);
  }
  return places;
}

/// Puts the first pressures of all scans first: the parts of one scan wait for its films.
void sort_by_pressure(const Study& study, std::vector<std::size_t>& parts) {
  const std::vector<std::size_t> places = places_of_pressures(study);
  std::stable_sort(parts.begin(), parts.end(),
                   [&](std::size_t a, std::size_t b) { return places[a] < places[b]; });
}

}  // namespace

std::vector<Study> parts_of(const Study& study) {
  std::vector<Study> parts;
  for (const Scan& scan : study.scans) {
    Study alone = study.of(scan);
    alone.experiment.reset();
    for (const double pressure : alone.settings.mean_pressures) {
      parts.push_back(alone);
      parts.back().settings.mean_pressures = {pressure};
      parts.back().scans.front().own.mean_pressures = {pressure};
    }
  }
  return parts;
}

Missing missing_parts(const Study& study, const std::filesystem::path& directory, bool retry,
                      const Observer& observer) {
  const engine::Store store(directory, engine::Store::Use::alone);
  const std::vector<ScanTasks> tasks = tasks_of(study, observer);
  const std::vector<engine::Job> jobs = friction_jobs(store, study, tasks);
  engine::Plan plan = engine::plan_jobs(jobs, &store, {}, retry, observer);
  std::set<std::size_t> wanted;
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    if (jobs[i].part && plan.entries[i].wanted) wanted.insert(*jobs[i].part);
  }
  Missing missing{{wanted.begin(), wanted.end()}, std::move(plan.warnings)};
  sort_by_pressure(study, missing.parts);
  return missing;
}

PartOutcome run_part(const Study& part, const std::filesystem::path& directory,
                     const engine::RunOptions& options) {
  const engine::Store store(directory, engine::Store::Use::shared);
  const std::vector<ScanTasks> tasks = tasks_of(part, options.observer);
  engine::Report report = engine::run_jobs(friction_jobs(store, part, tasks), &store, options);
  report.rethrow();
  return {report.computed(kind_of(FrictionJob::contact)), std::move(report.failures)};
}

}  // namespace tabor::study
