#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "tabor/cli/verb.hpp"

// Runs the same work for several scan files side by side, as params and psd do.
namespace tabor::cli {

/// Work on one of several scan files.
struct ScanWork {
  std::string verb;                                             ///< what a person watching calls it
  double bytes_per_pixel = 0;                                   ///< memory that it takes
  std::function<void(std::size_t place, const Observer&)> run;  ///< on any thread
};

/// Runs the work for every file, for several at a time where there are threads and memory for it.
/// Throws what the first of the files for which it failed made it throw.
void for_each_scan(const std::vector<std::string>& files, const ScanWork& work,
                   const Context& context);

}  // namespace tabor::cli
