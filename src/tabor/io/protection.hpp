#pragma once

namespace tabor::io {

// What a program that reads files of unknown origin can do to protect itself. Both change the whole
// process, so both are off until the program asks for them: a library that forks, or that installs
// signal handlers, would surprise the program it is linked into. The command line program `tabor`
// switches on both at its start. Call them from one thread, before files are read.

/// Whether HDF5 files are read in a copy of the process (fork) first, under limits of memory and
/// processor time. The HDF5 library trusts what a file says about itself: damaged and forged files
/// crash it or make it ask for gigabytes. With the copy such a file is an InputError; without it,
/// it may end the process. Reading takes up to twice as long with it.
void isolate_hdf5_reading(bool on);
bool hdf5_reading_is_isolated();

/// Whether a handler of SIGBUS puts zeros in the place of pages of a mapped file that vanish while
/// it is read, because another program cuts the file short or a network drive goes away; reading
/// then ends with an InputError. Without it the signal ends the process. Bus errors of other origin
/// are passed on to the handler that was there before. Switched off, that handler is back.
void trap_lost_pages(bool on);
bool lost_pages_are_trapped();

}  // namespace tabor::io
