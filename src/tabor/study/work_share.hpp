#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

namespace tabor::study {

/// What a worker of a sweep does at a time.
struct Task {
  enum class Kind { surface, film, contact, fluid };
  Kind kind;
  std::size_t scan;
  std::size_t pressure = 0;   ///< of a contact or a film that flows
  std::size_t condition = 0;  ///< of a film that flows
  bool retry = false;         ///< of a film that flows: solve again although stored
};

/// How much of a sweep's time is left, from what its own tasks took: a task is expected to take as
/// long as those of its kind that have ended or, before the first of them has, as one that runs and
/// says how far it is. While tasks are open of which no kind has been seen there is no estimate.
class WorkShare {
 public:
  using Clock = std::function<double()>;  ///< [s] since the sweep began

  WorkShare(const std::vector<Task>& tasks, Clock clock);

  void set_workers(int n_workers) { n_workers_ = n_workers; }

  /// The task starts now; again for one that has only waited until now.
  void begin(std::size_t task) { started_[task] = clock_(); }
  void inside(std::size_t task, double share) { done_[task] = share; }
  void end(std::size_t task);

  /// [s]; nullopt as long as there is nothing to tell it from.
  std::optional<double> seconds_left() const;

  /// Time gone over time in all, 0..1; NaN as long as nobody can tell.
  double share() const;

 private:
  static constexpr std::size_t kKinds = 4;

  struct Cost {
    double seconds = 0;
    double n = 0;
  };
  std::array<Cost, kKinds> costs() const;

  std::vector<std::size_t> kinds_;              // per task
  std::vector<double> done_;                    // per task, 0..1
  std::vector<std::optional<double>> started_;  // per task
  std::array<Cost, kKinds> ended_{};
  Clock clock_;
  int n_workers_ = 1;
};

}  // namespace tabor::study
