#pragma once

#include <functional>
#include <iosfwd>
#include <string>
#include <utility>

#include "tabor/cli/time_left.hpp"
#include "tabor/core/convergence.hpp"
#include "tabor/core/resources.hpp"

namespace tabor::cli {

/// How a person follows a long computation.
enum class ProgressStyle {
  none,      ///< --quiet
  lines,     ///< a plain line every 10 s: logs, batch systems
  terminal,  ///< one line that is overwritten ten times a second
};

/// Terminal if stderr is one, lines otherwise.
ProgressStyle progress_style_of_stderr(bool quiet);

/// Prints stage, residual and time left; its observer() also stops a computation after Ctrl-C. The
/// time left is that of the whole computation where it says how far it is (a sweep), else that of
/// the stage.
class ProgressPrinter {
 public:
  using Clock = std::function<double()>;  ///< [s]

  ProgressPrinter(std::ostream& err, ProgressStyle style);
  /// For tests, which move the clock themselves.
  ProgressPrinter(std::ostream& err, ProgressStyle style, Clock clock)
      : err_(err), style_(style), clock_(std::move(clock)), whole_(clock_()) {}
  ~ProgressPrinter() { clear(); }
  ProgressPrinter(const ProgressPrinter&) = delete;
  ProgressPrinter& operator=(const ProgressPrinter&) = delete;

  /// Valid as long as this object lives.
  Observer observer();

  /// Removes the line a terminal shows, before other output.
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
  double share_ = 0;              ///< of the stage, as far as it was told
  double last_shown_ = 0;         ///< [s]
  double first_certificate_ = 0;  ///< of the stage
  bool line_on_screen_ = false;
};

}  // namespace tabor::cli
