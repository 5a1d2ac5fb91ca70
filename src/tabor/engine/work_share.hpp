#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace tabor::engine {

/// Estimates the remaining time of a run from the times of its own jobs: a job is expected to take
/// as long as those of its kind that have ended or, before the first of them has, as one that runs
/// and reports its share. There is no estimate while jobs are open whose kind has no time yet.
class WorkShare {
 public:
  using Clock = std::function<double()>;  ///< [s] since the run began

  /// `kinds` has the kind of each job; "" for one whose time does not count.
  WorkShare(std::vector<std::string> kinds, Clock clock);

  void set_workers(int n_workers) { n_workers_ = n_workers; }

  /// Starts the time of a job; called again for one that has only waited until now.
  void begin(std::size_t job) { started_[job] = clock_(); }
  void inside(std::size_t job, double share) { done_[job] = share; }
  void end(std::size_t job);

  /// Returns the remaining time [s]; nullopt while there is no estimate.
  std::optional<double> seconds_left() const;

  /// Returns elapsed over total time, 0..1; NaN while there is no estimate.
  double share() const;

 private:
  struct Cost {
    double seconds = 0;
    double n = 0;
  };
  std::map<std::string, Cost> costs() const;

  std::vector<std::string> kinds_;              // per job
  std::vector<double> done_;                    // per job, 0..1
  std::vector<std::optional<double>> started_;  // per job
  std::map<std::string, Cost> ended_;
  Clock clock_;
  int n_workers_ = 1;
};

}  // namespace tabor::engine
