#pragma once

#include <functional>
#include <string>

// Lists the exit codes of the program and translates exceptions into them.
namespace tabor::cli {

/// Exit code of the process.
enum ExitCode : int {
  kDone = 0,
  kInternal = 1,       ///< a bug of ours
  kUsage = 2,          ///< the command line is wrong
  kInput = 3,          ///< input cannot be read or is invalid
  kNotConverged = 4,   ///< finished, but a result is not converged
  kOutput = 5,         ///< a result cannot be written
  kInterrupted = 130,  ///< Ctrl-C; finished results remain
};

/// Reports an error in one line and returns the exit code.
using Complaint = std::function<int(const std::string& line, int code)>;

/// Runs `body` and turns every exception into a complaint with its exit code. No other place maps
/// errors to numbers.
int guarded(const Complaint& complain, const std::function<int()>& body);

}  // namespace tabor::cli
