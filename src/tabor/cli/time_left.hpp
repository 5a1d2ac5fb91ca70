#pragma once

#include <optional>
#include <string>

namespace tabor::cli {

/// What is left of a computation that now and then says which share of it is done. An early share
/// or one that jumps is no basis: nothing is told before a twentieth of the work and some seconds
/// are done, and only while the last seconds agree on when it ends.
class TimeLeft {
 public:
  /// `start` [s]: when the work began, on the clock of at().
  explicit TimeLeft(double start = 0) : start_(start) {}

  /// Takes note of the share (0..1, NaN if unknown) that is done at `now`, and says how many
  /// seconds are left.
  std::optional<double> at(double now, double share);

 private:
  double start_;
  double last_ = 0;                 ///< [s] when the end was estimated last
  double known_since_ = 0;          ///< [s]
  std::optional<double> end_ = {};  ///< [s] mean of the last seconds' estimates
};

/// "12 s", "3 min 20 s", "2 h 5 min"
std::string format_duration(double seconds);

/// The same with no more digits than an estimate has: "40 s", "3 min 20 s", "25 min".
std::string format_estimate(double seconds);

}  // namespace tabor::cli
