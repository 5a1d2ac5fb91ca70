#include "tabor/study/ehl_sweep.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "tabor/core/error.hpp"
#include "tabor/core/text.hpp"
#include "tabor/engine/plan.hpp"

namespace tabor::study {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// The value of a study's key at one of its factors; numbers of nodes make whole cells.
double value_at(const ehl::CaseStudy& study, double usual, double factor) {
  if (!study.is_count) return usual * factor;
  const double cells = (usual - study.end_nodes) * factor / study.cells_by;
  return study.end_nodes + study.cells_by * std::round(cells);
}

/// What stands in the store already, for whoever wonders why a sweep begins anew or does not. What
/// is damaged is removed.
EhlFound look(const EhlSeries& series, const EhlStore& store, const engine::RunOptions& options) {
  EhlFound found;
  found.n_cases = series.cases.size();
  found.n_unused = store.n_unused(series);
  EhlResults ignored;
  const std::vector<engine::Job> jobs = ehl_jobs(series, &store.store(), ignored, found.damaged);
  const engine::Plan plan =
      engine::plan_jobs(jobs, &store.store(), options.shard.value_or(engine::Shard{}),
                        options.retry, options.observer);
  found.n_kept = plan.n_found;
  found.damaged.insert(found.damaged.end(), plan.warnings.begin(), plan.warnings.end());
  return found;
}

/// Nothing where it is not there, or where another shard has to compute it again.
std::optional<ehl::CaseResult> kept_case(const EhlSeries& series, const engine::Store& store,
                                         const engine::Task& task) {
  if (!store.has(task)) return std::nullopt;
  try {
    return read_ehl_case(store, task, series.program.columns);
  } catch (const InputError&) {
    return std::nullopt;
  }
}

/// Adds what was computed before, or by another shard.
void read_kept(const EhlSeries& series, const engine::Store& store, EhlOutcome& outcome) {
  for (const EhlCase& one : series.cases) {
    std::optional<ehl::CaseResult>& result = outcome.results[one.place];
    if (!result) result = kept_case(series, store, one.task);
    outcome.n_kept += store.has(one.task) ? 1 : 0;
  }
}

std::vector<double> numbers_of(const std::vector<ehl::CaseResult>& results,
                               const std::string& key) {
  std::vector<double> numbers;
  numbers.reserve(results.size());
  for (const ehl::CaseResult& result : results) numbers.push_back(result.number(key));
  return numbers;
}

bool is_rejected(const ehl::CaseResult& result) { return result.rejected(); }

void throw_first_rejection(const std::vector<ehl::CaseResult>& results) {
  const auto rejected = std::find_if(results.begin(), results.end(), is_rejected);
  if (rejected != results.end()) throw InputError(rejected->error);
}

std::vector<ehl::CaseResult> solve_all(const EhlSeries& series, const engine::RunOptions& options) {
  const EhlOutcome outcome = run_ehl(series, nullptr, options);
  if (outcome.ended_by) std::rethrow_exception(outcome.ended_by);
  std::vector<ehl::CaseResult> results = outcome.all();
  throw_first_rejection(results);
  return results;
}

}  // namespace

bool EhlOutcome::is_complete() const {
  return std::all_of(results.begin(), results.end(),
                     [](const auto& result) { return result.has_value(); });
}

std::vector<ehl::CaseResult> EhlOutcome::all() const {
  std::vector<ehl::CaseResult> all;
  for (const std::optional<ehl::CaseResult>& result : results) all.push_back(result.value());
  if (std::all_of(all.begin(), all.end(), is_rejected)) throw_first_rejection(all);
  return all;
}

EhlOutcome run_ehl(const EhlSeries& series, const EhlStore* store,
                   const engine::RunOptions& options,
                   const std::function<void(const EhlFound&)>& told) {
  if (store && told) told(look(series, *store, options));
  EhlOutcome outcome;
  std::vector<std::string> damaged;
  const engine::Store* const folder = store ? &store->store() : nullptr;
  const engine::Report report =
      engine::run_jobs(ehl_jobs(series, folder, outcome.results, damaged), folder, options);
  outcome.n_computed = report.computed("case");
  outcome.ended_by = report.ended_by;
  if (folder) read_kept(series, *folder, outcome);
  return outcome;
}

const ehl::CaseStudy& find_study(const ehl::Program& program, const std::string& name) {
  std::vector<std::string> names;
  for (const ehl::CaseStudy& study : program.studies) {
    if (study.name == name) return study;
    names.push_back(study.name);
  }
  throw UsageError(fmt::format("study '{}'{}; 'tabor ehl {}' knows {}", name,
                               suggestion(name, names), program.name,
                               names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "))));
}

const ehl::CaseStudy* study_of(const ehl::Program& program, const std::vector<SweepAxis>& axes) {
  if (axes.size() != 1 || axes.front().values.size() < 3) return nullptr;
  for (const ehl::CaseStudy& study : program.studies) {
    if (study.has_limit && study.key == axes.front().key) return &study;
  }
  return nullptr;
}

EhlStudyOutcome run_ehl_study(const ehl::Program& program, const io::Config& config,
                              const ehl::CaseStudy& study, std::uint64_t seed,
                              const engine::RunOptions& options) {
  ehl::Program alone = program;
  alone.make_chain = {};
  // What the case does not say is what its solution says it took.
  const auto usual = solve_all(ehl_sweep(alone, config, {}, seed), options);
  const double value = usual.front().number(study.number);
  if (!std::isfinite(value)) {
    throw InputError("study " + study.name, "a case that has no " + study.key, "", "");
  }
  SweepAxis axis{.key = study.key, .values = {}, .is_range = true};
  for (const double factor : study.factors) {
    axis.values.push_back(fmt::format("{:.12g}{}", value_at(study, value, factor),
                                      study.unit.empty() ? "" : " " + study.unit));
  }
  auto results = solve_all(ehl_variants(program, config, study.key, axis.values, seed), options);
  return {std::move(axis), std::move(results)};
}

ehl::CaseColumns columns_of(const ehl::Program& program,
                            const std::vector<ehl::CaseResult>& results) {
  ehl::CaseColumns columns;
  for (const ColumnHead& column : program.columns) {
    const auto knows = [&](const ehl::CaseResult& result) {
      return std::isfinite(result.number(column.key));
    };
    const bool is_known =
        column.is_in(ehl::media::kWhereKnown) && std::any_of(results.begin(), results.end(), knows);
    if (is_known || column.is_in(ehl::media::kTable)) columns.push_back(column);
  }
  return columns;
}

std::vector<numerics::GridLimit> limits_of(const ehl::CaseColumns& columns,
                                           const ehl::CaseStudy& study,
                                           const std::vector<double>& values,
                                           const std::vector<ehl::CaseResult>& results) {
  std::vector<double> spacing(values);
  if (study.is_count) {
    for (double& value : spacing) value = 1 / (value - study.end_nodes);
  }
  std::vector<numerics::GridLimit> limits;
  limits.reserve(columns.size());
  for (const ColumnHead& column : columns) {
    limits.push_back(column.is_in(ehl::media::kLimit)
                         ? numerics::limit_of(spacing, numbers_of(results, column.key))
                         : numerics::GridLimit{kNone, kNone});
  }
  return limits;
}

}  // namespace tabor::study
