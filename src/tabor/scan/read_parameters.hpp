#pragma once

#include "tabor/record/parameter.hpp"
#include "tabor/scan/file.hpp"

// Defines what a user can say of a scan file. Options of the verbs, keys of study files and
// arguments of Python are made from this table.
namespace tabor::scan {

/// Heading of these options in help.
inline constexpr const char* kReadingGroup = "Reading the file";

/// Returns the settings of reading, each in one line.
const Parameters<ReadOptions>& read_parameters();

}  // namespace tabor::scan
