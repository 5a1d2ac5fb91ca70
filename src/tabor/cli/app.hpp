#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "tabor/cli/progress.hpp"

// Runs the program `tabor` on the words of a command line, with or without setting up the process.
namespace tabor::cli {

/// Runs the program without setting up the process: args are the words after the program name.
/// Writes results to `out`, everything else to `err`, and returns the exit code. Never throws.
int run(const std::vector<std::string>& args, std::ostream& out, std::ostream& err,
        ProgressStyle style = ProgressStyle::none);

/// Sets up the process (idle threads sleep, Ctrl-C is caught, files of unknown origin do no harm,
/// see io/files/protection.hpp) and runs the program. May replace the process image once, see
/// app.cpp.
int run(int argc, char** argv);

}  // namespace tabor::cli
