#pragma once

#include <cstddef>
#include <exception>
#include <map>
#include <string>
#include <vector>

#include "tabor/engine/job.hpp"
#include "tabor/engine/run_options.hpp"
#include "tabor/engine/store.hpp"

// Runs many cases of any kind: plans, stores, resumes and retries them, several at a time, shared
// out to processes. It knows nothing of what is computed. A client
//
//   1. makes a Task of every result that it stores (task.hpp). Everything that the result depends
//      on stands in the task's text, which decides the file: raise a number in it when the same
//      input gives other results than before;
//   2. opens a Store, the folder of these files, or none. Without a store every job is done, and
//      hands its result on through what its functions capture;
//   3. lists its Jobs (job.hpp), each behind those it needs, and calls run_jobs(). Among the jobs
//      that are ready the first of the list is done first;
//   4. reads from the store what it wants to show, whether it was computed now or before, and calls
//      Report::rethrow() once the finished results are shown or written.
//
// friction_graph.cpp lists the jobs of a surface: surface, films, contacts, fluid, rows. Cases that
// each start from the one before are jobs that need each other in a chain:
//
//   - the file is the case's checkpoint (checkpoint.hpp): its numbers, and the name and digest of a
//     file that holds the start of the next case. compute() writes that file before the checkpoint
//     and removes it when the next checkpoint is there;
//   - the text of a case names the key of the one before it ("after = ..."), `needs` its place, and
//     all cases of a chain are of one `part`, so that one shard does them all;
//   - `can_serve` is true if the file of the start is whole; the chain's state is in memory, shared
//     by the functions of its jobs, and compute() reads the start when it is not;
//   - a case that fails or does not converge is a result: compute() stores its message instead of
//     throwing it, the next one starts anew, and `quality` says so to --retry. After it all cases
//     that follow in the chain are computed again, too.
namespace tabor::engine {

/// End of a run.
struct Report {
  std::map<std::string, std::size_t> n_computed;  ///< by kind; recorded failures count
  std::map<std::string, double> seconds;          ///< by kind: of wall time, added up over its jobs
  std::size_t n_found = 0;                        ///< jobs whose results were stored before
  std::vector<std::string> failures;              ///< of the jobs that failed by themselves
  std::vector<std::string> warnings;              ///< one per damaged file
  std::exception_ptr ended_by;  ///< Interrupted or what else ended it early; null if it is complete

  std::size_t computed(const std::string& kind) const;
  void rethrow() const;
};

/// Runs every job whose result the store does not hold yet. Results do not depend on the number of
/// jobs, on threads, shards or interruptions. Throws what plan_jobs() throws (plan.hpp); an
/// exception that ends the run later is in the report, after every running job has ended.
Report run_jobs(std::vector<Job> jobs, const Store* store, const RunOptions& options = {});

}  // namespace tabor::engine
