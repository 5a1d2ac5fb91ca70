#pragma once

#include <string>
#include <vector>

#include "tabor/core/convergence.hpp"
#include "tabor/engine/job.hpp"
#include "tabor/engine/run_options.hpp"
#include "tabor/engine/store.hpp"

// Decides which jobs of a list remain to be done, and how many run at the same time.
namespace tabor::engine {

/// Selection of the jobs of a list that are to be done.
struct Plan {
  struct Entry {
    bool wanted = false;   ///< to be done
    bool retried = false;  ///< although its file is whole
  };
  std::vector<Entry> entries;         ///< one per job
  std::size_t n_found = 0;            ///< jobs of this shard whose files are whole and stay
  std::vector<std::string> warnings;  ///< one per damaged file, which is removed
};

/// Compares the jobs with the store; without one, all jobs that are needed are to be done. Throws
/// Interrupted when the observer stops it, OutputError if a damaged file cannot be removed.
Plan plan_jobs(const std::vector<Job>& jobs, const Store* store, const Shard& shard, bool retry,
               const Observer& observer = {});

/// Returns how many jobs run at the same time: one per thread as long as they fit in half of the
/// available memory; at least one.
int jobs_that_fit(std::size_t bytes_per_job, std::size_t available_bytes, int n_threads);

}  // namespace tabor::engine
