#pragma once

#include <vector>

#include "tabor/cli/ehl_kept.hpp"
#include "tabor/cli/ehl_series.hpp"

/// All cases of a sweep.
namespace tabor::cli {

/// The cases of a sweep, and in which order to solve them.
struct EhlCases {
  std::vector<io::Config> configs;  ///< as asked for
  std::vector<std::size_t> order;   ///< of their indices

  EhlCases(const EhlSeries& series, const std::vector<SweepAxis>& axes,
           const std::vector<std::vector<std::size_t>>& combinations);
};

/// Where a sweep with this output keeps its finished cases until all are done.
std::filesystem::path kept_folder(const EhlSeries& series);
KeptCases kept_cases(const EhlSeries& series, const EhlCases& cases, Context& context);

/// Solves a case whose warnings, those said meanwhile too, are its own; without its text and maps.
/// Throws InputError, Interrupted.
EhlAnswer solve_one_of_many(const EhlSolver& solve, const io::Config& config, Context& context);

/// Solves the cases that are not kept, keeps each as soon as it is there, and says on stderr how
/// many were. `kept`: null where the sweep has no output. An invalid case is an answer
/// like another. Throws InputError for a key that no case has and where no case makes sense,
/// Interrupted.
std::vector<EhlAnswer> solve_cases(const EhlSeries& series, const EhlCases& cases, KeptCases* kept,
                                   Context& context);

}  // namespace tabor::cli
