#pragma once

#include <array>
#include <cstddef>
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

/// Which share of the time of all tasks has gone. Tasks of a kind take about as long as those of
/// that kind that have ended; until one has, as long as on a typical scan.
class WorkShare {
 public:
  explicit WorkShare(const std::vector<Task>& tasks);

  void inside(std::size_t task, double share) { done_[task] = share; }
  void end(std::size_t task, double seconds);
  double share() const;

 private:
  static constexpr std::size_t kKinds = 4;
  double expected(std::size_t kind) const;

  std::vector<std::size_t> kinds_;        // per task
  std::vector<double> done_;              // per task, 0..1
  std::array<double, kKinds> seconds_{};  // of those that ended
  std::array<double, kKinds> ended_{};
};

}  // namespace tabor::study
