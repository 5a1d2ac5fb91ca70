#pragma once

#include <exception>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tabor/engine/engine.hpp"
#include "tabor/numerics/grid_limit.hpp"
#include "tabor/study/ehl_jobs.hpp"

// Sweeps over the values of a case, and studies of how far a result depends on its grid.
namespace tabor::study {

/// What a sweep found of its cases before it computed any.
struct EhlFound {
  std::size_t n_cases = 0;           ///< of this shard, or of all
  std::size_t n_kept = 0;            ///< of them that need not be computed
  std::size_t n_unused = 0;          ///< stored cases of another case file, sweep or version
  std::vector<std::string> damaged;  ///< one line per file that cannot be used
};

/// How a series ended.
struct EhlOutcome {
  EhlResults results;           ///< as asked for; empty: not computed, by this shard or any other
  std::size_t n_kept = 0;       ///< cases that are in the store
  std::size_t n_computed = 0;   ///< now
  std::exception_ptr ended_by;  ///< Interrupted or what else ended it early; null if it is complete

  bool is_complete() const;
  /// Results of all cases. Throws InputError, with the message of the first one, if none makes
  /// sense: rows without a number say nothing but why.
  std::vector<ehl::CaseResult> all() const;
};

/// Solves the cases that the store does not hold yet; `told`, if there is one, is told once what it
/// holds. Results do not depend on options, threads or interruptions. Throws what plan_jobs()
/// throws; whatever ends the run later is in the outcome.
EhlOutcome run_ehl(const EhlSeries& series, const EhlStore* store,
                   const engine::RunOptions& options,
                   const std::function<void(const EhlFound&)>& told = {});

/// The study of this name. Throws UsageError with those that the program knows.
const ehl::CaseStudy& find_study(const ehl::Program& program, const std::string& name);

/// The study that a sweep amounts to: three values or more of what it varies; null if to none.
const ehl::CaseStudy* study_of(const ehl::Program& program, const std::vector<SweepAxis>& axes);

/// A case with other values of one key, each solved by itself.
struct EhlStudyOutcome {
  SweepAxis axis;
  std::vector<ehl::CaseResult> results;
};

/// Solves the case as it is, which says what it took where the case does not, and with the values
/// that lie at the study's factors around that. Throws InputError for invalid input,
/// Interrupted.
EhlStudyOutcome run_ehl_study(const ehl::Program& program, const io::Config& config,
                              const ehl::CaseStudy& study, std::uint64_t seed,
                              const engine::RunOptions& options);

/// The columns of the table of these cases.
ehl::CaseColumns columns_of(const ehl::Program& program,
                            const std::vector<ehl::CaseResult>& results);

/// What each column tends to on ever finer grids, and the order of the error that it shows.
/// `values`: of what the study varies, at least three.
std::vector<numerics::GridLimit> limits_of(const ehl::CaseColumns& columns,
                                           const ehl::CaseStudy& study,
                                           const std::vector<double>& values,
                                           const std::vector<ehl::CaseResult>& results);

}  // namespace tabor::study
