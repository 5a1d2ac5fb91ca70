#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace tabor::study {

/// How much of a run's time is left, from what its own jobs took: a job is expected to take as long
/// as those of its kind that have ended or, before the first of them has, as one that runs and says
/// how far it is. While jobs are open of which no kind has been seen there is no estimate.
class WorkShare {
 public:
  using Clock = std::function<double()>;  ///< [s] since the run began

  /// The kind of each job; "" for one whose time does not count.
  WorkShare(std::vector<std::string> kinds, Clock clock);

  void set_workers(int n_workers) { n_workers_ = n_workers; }

  /// The job starts now; again for one that has only waited until now.
  void begin(std::size_t job) { started_[job] = clock_(); }
  void inside(std::size_t job, double share) { done_[job] = share; }
  void end(std::size_t job);

  /// [s]; nullopt as long as there is nothing to tell it from.
  std::optional<double> seconds_left() const;

  /// Time gone over time in all, 0..1; NaN as long as nobody can tell.
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

}  // namespace tabor::study
