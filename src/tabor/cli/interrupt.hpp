#pragma once

namespace tabor::cli {

/// From now on the first Ctrl-C (SIGINT), SIGTERM or SIGHUP only sets a flag; a second one ends the
/// process. A SIGHUP that was ignored before stays ignored.
void catch_interrupts();

/// From now on a file that would grow beyond what the shell allows (ulimit -f) fails to be written,
/// as on a full disk, instead of ending the process.
void let_writing_fail();

/// True once the user asked to stop.
bool interrupted();

/// For tests: sets or clears the flag as the signal handler would.
void set_interrupted(bool value);

}  // namespace tabor::cli
