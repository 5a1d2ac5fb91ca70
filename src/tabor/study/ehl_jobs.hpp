#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tabor/study/ehl_cases.hpp"
#include "tabor/study/job.hpp"
#include "tabor/study/store.hpp"

namespace tabor::study {

/// The folder of the finished cases of one sweep, from which it goes on where it was stopped. What
/// outlives the sweep stands elsewhere: finish() lets the cases go with this object.
class EhlStore {
 public:
  /// Throws InputError if another sweep works on the folder, OutputError if it cannot be written.
  EhlStore(const std::filesystem::path& folder, Store::Use use);
  /// Alone, removes the folder if nothing is in it, or nothing but the cases of a finished sweep.
  ~EhlStore();
  EhlStore(const EhlStore&) = delete;
  EhlStore& operator=(const EhlStore&) = delete;

  const Store& store() const { return store_; }
  const std::filesystem::path& folder() const { return store_.folder(); }
  void finish() { is_finished_ = true; }

  /// Of cases that are none of this series.
  std::size_t n_unused(const EhlSeries& series) const;

 private:
  Store store_;
  bool is_finished_ = false;
};

/// What of a result is kept: numbers, whether it converged, and warnings. A case that makes no
/// sense is a result, too: its scalar "refused" says why.
using EhlResults = std::vector<std::optional<ehl::CaseResult>>;
bool is_rejected(const ehl::CaseResult& result);

/// A kept case. Throws InputError if it is damaged or of another task.
ehl::CaseResult read_ehl_case(const Store& store, const Task& task);

/// The jobs of a series, for run_jobs(): one per case, in a chain those behind each other, which is
/// one part. Results go to `results`, by the place of the case as it was asked for, and into the
/// store if there is one; `damaged` gets a line for each start that cannot be used. Everything
/// given must outlive the jobs.
std::vector<Job> ehl_jobs(const EhlSeries& series, const Store* store, EhlResults& results,
                          std::vector<std::string>& damaged);

}  // namespace tabor::study
