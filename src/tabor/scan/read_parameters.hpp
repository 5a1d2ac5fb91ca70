#pragma once

#include "tabor/record/parameter.hpp"
#include "tabor/scan/file.hpp"

namespace tabor::scan {

/// What can be said of a scan file, each in one line: options of the verbs, keys of study files and
/// arguments of Python are made from it.
const Parameters<ReadOptions>& read_parameters();

}  // namespace tabor::scan
