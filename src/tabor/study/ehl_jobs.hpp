#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tabor/engine/job.hpp"
#include "tabor/engine/store.hpp"
#include "tabor/study/ehl_cases.hpp"

// Makes the jobs of a series of films under load, and reads their stored results.
namespace tabor::study {

/// The folder of the finished cases of one sweep, from which it goes on where it was stopped. What
/// outlives the sweep stands elsewhere: finish() lets the cases go with this object.
class EhlStore {
 public:
  /// Throws InputError if another sweep works on the folder, OutputError if it cannot be written.
  EhlStore(const std::filesystem::path& folder, engine::Store::Use use);
  /// Alone, removes the folder if nothing is in it, or nothing but the cases of a finished sweep.
  ~EhlStore();
  EhlStore(const EhlStore&) = delete;
  EhlStore& operator=(const EhlStore&) = delete;

  const engine::Store& store() const { return store_; }
  const std::filesystem::path& folder() const { return store_.folder(); }
  void finish() { is_finished_ = true; }

  /// Returns the number of stored cases that are none of this series.
  std::size_t n_unused(const EhlSeries& series) const;

 private:
  engine::Store store_;
  bool is_finished_ = false;
};

/// Results as they are stored: numbers, status and warnings. A rejected case is a result, too.
using EhlResults = std::vector<std::optional<ehl::CaseResult>>;

/// Reads a stored case with these columns. Throws InputError if it is damaged or of another task.
ehl::CaseResult read_ehl_case(const engine::Store& store, const engine::Task& task,
                              const ehl::CaseColumns& columns);

/// The jobs of a series, for run_jobs(): one per case, in a chain those behind each other, which is
/// one part. Results go to `results`, by the place of the case as it was asked for, and into the
/// store if there is one; `damaged` gets a line for each start that cannot be used. Everything
/// given must outlive the jobs.
std::vector<engine::Job> ehl_jobs(const EhlSeries& series, const engine::Store* store,
                                  EhlResults& results, std::vector<std::string>& damaged);

}  // namespace tabor::study
