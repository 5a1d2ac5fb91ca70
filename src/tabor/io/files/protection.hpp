#pragma once

// Switches on what protects a program against damaged and hostile files. Both switches change the
// whole process, so both are off until the program asks: a library that forks, or that installs
// signal handlers, would surprise the program it is linked into. The program `tabor` switches on
// both at its start. Call them from one thread, before files are read.
namespace tabor::io {

/// Switches on or off that HDF5 files are read in a copy of the process (fork) first, under limits
/// of memory and processor time. The HDF5 library trusts what a file says about itself: damaged and
/// forged files crash it or make it request gigabytes. With the copy such a file is an InputError;
/// without it, it may end the process. Reading takes up to twice as long with it.
void isolate_hdf5_reading(bool on);
bool hdf5_reading_is_isolated();

/// Switches on or off a handler of SIGBUS that replaces pages of a mapped file by zeros when they
/// vanish during reading, because another program cuts the file short or a network drive
/// disappears; reading then ends with an InputError. Without it the signal ends the process. Bus
/// errors of other origin are passed on to the previous handler, which is restored when this one is
/// switched off.
void trap_lost_pages(bool on);
bool lost_pages_are_trapped();

}  // namespace tabor::io
