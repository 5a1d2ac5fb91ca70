#pragma once

namespace tabor::cli {

/// From now on the first Ctrl-C (SIGINT) or SIGTERM only sets a flag; a second one ends the
/// process.
void catch_interrupts();

/// True once the user asked to stop.
bool interrupted();

/// For tests: sets or clears the flag as the signal handler would.
void set_interrupted(bool value);

}  // namespace tabor::cli
