#pragma once

#include <iosfwd>
#include <string>

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

/// Prints stage, residual and time left; its observer() also stops a computation after Ctrl-C.
class ProgressPrinter {
 public:
  ProgressPrinter(std::ostream& err, ProgressStyle style) : err_(err), style_(style) {}
  ~ProgressPrinter() { clear(); }
  ProgressPrinter(const ProgressPrinter&) = delete;
  ProgressPrinter& operator=(const ProgressPrinter&) = delete;

  /// Valid as long as this object lives.
  Observer observer();

  /// Removes the line a terminal shows, before other output.
  void clear();

 private:
  void show(const Progress& progress);

  std::ostream& err_;
  ProgressStyle style_;
  std::string stage_;
  Stopwatch since_start_;
  double stage_start_ = 0;        ///< [s]
  double last_shown_ = 0;         ///< [s]
  double first_certificate_ = 0;  ///< of the stage
  bool line_on_screen_ = false;
};

/// "12 s", "3 min 20 s", "2 h 5 min"
std::string format_duration(double seconds);

}  // namespace tabor::cli
