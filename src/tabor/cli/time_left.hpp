#pragma once

#include <optional>
#include <string>

// Estimates the remaining time of a computation from the share that is done.
namespace tabor::cli {

/// Estimates the remaining time of a computation from the share that is done; silent until 5 % and
/// some seconds are done, and while recent estimates disagree.
class TimeLeft {
 public:
  /// `start` [s]: when the work began, on the clock of at().
  explicit TimeLeft(double start = 0) : start_(start) {}

  /// Records the share (0..1, NaN if unknown) that is done at `now`, and returns the remaining
  /// seconds.
  std::optional<double> at(double now, double share);

 private:
  double start_;
  bool is_told_share_ = false;
  double share_before_ = 0;         ///< done by an earlier run that this one continues
  double last_ = 0;                 ///< [s] when the end was estimated last
  double known_since_ = 0;          ///< [s]
  std::optional<double> end_ = {};  ///< [s] mean of the last seconds' estimates
};

/// Returns a duration as text: "12 s", "3 min 20 s", "2 h 5 min".
std::string format_duration(double seconds);

/// Returns a duration rounded as an estimate: "40 s", "3 min 20 s", "25 min".
std::string format_estimate(double seconds);

}  // namespace tabor::cli
