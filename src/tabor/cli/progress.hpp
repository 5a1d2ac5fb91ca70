#pragma once

#include <functional>
#include <iosfwd>
#include <string>
#include <utility>

#include "tabor/cli/time_left.hpp"
#include "tabor/core/convergence.hpp"
#include "tabor/core/resources.hpp"

// Shows the progress of a long computation on stderr and stops it after Ctrl-C.
namespace tabor::cli {

/// Form in which progress is shown.
enum class ProgressStyle {
  none,      ///< --quiet
  lines,     ///< a plain line every 10 s: logs, batch systems
  terminal,  ///< one line that is overwritten ten times a second
};

/// Returns `terminal` if stderr is one, `lines` otherwise; `none` if quiet.
ProgressStyle progress_style_of_stderr(bool quiet);

/// Prints stage, residual and remaining time; its observer() also stops a computation after Ctrl-C.
/// The remaining time is that of the whole computation where it reports its share (a sweep), else
/// that of the stage.
class ProgressPrinter {
 public:
  using Clock = std::function<double()>;  ///< [s]

  ProgressPrinter(std::ostream& err, ProgressStyle style);
  /// Takes another clock, for tests.
  ProgressPrinter(std::ostream& err, ProgressStyle style, Clock clock)
      : err_(err), style_(style), clock_(std::move(clock)), whole_(clock_()) {}
  ~ProgressPrinter() { clear(); }
  ProgressPrinter(const ProgressPrinter&) = delete;
  ProgressPrinter& operator=(const ProgressPrinter&) = delete;

  /// Returns an observer that is valid as long as this object lives.
  Observer observer();

  /// Removes the progress line from a terminal, before other output.
  void clear();

 private:
  void show(const Progress& progress);
  double share_of_stage(const Progress& progress, double now);

  std::ostream& err_;
  ProgressStyle style_;
  Clock clock_;
  TimeLeft whole_;
  std::string stage_;
  TimeLeft of_stage_;
  double share_ = 0;              ///< of the stage, as last reported
  double last_shown_ = 0;         ///< [s]
  double first_certificate_ = 0;  ///< of the stage
  bool line_on_screen_ = false;
};

}  // namespace tabor::cli
