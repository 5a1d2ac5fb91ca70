#pragma once

// Turns Ctrl-C and similar signals into a flag that long computations ask for.
namespace tabor::cli {

/// Makes the first Ctrl-C (SIGINT), SIGTERM or SIGHUP only set a flag; a second one ends the
/// process. A SIGHUP that was ignored before stays ignored.
void catch_interrupts();

/// Makes writing fail, as on a full disk, where a file would grow beyond what the shell allows
/// (ulimit -f); otherwise that would end the process.
void let_writing_fail();

/// True once the user asked to stop.
bool interrupted();

/// Sets or clears the flag as the signal handler would; for tests.
void set_interrupted(bool value);

}  // namespace tabor::cli
