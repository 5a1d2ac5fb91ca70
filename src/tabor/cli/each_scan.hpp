#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "tabor/cli/verb.hpp"

// Runs the same work for several scan files side by side, as params and psd do.
namespace tabor::cli {

/// Runs run(place, observer) for every file, on any thread: several at a time where there are
/// threads and memory for it. `verb` is what a person watching calls the work. Throws what the
/// first of the files for which it failed made it throw.
void for_each_scan(const std::vector<std::string>& files, const std::string& verb,
                   const std::function<void(std::size_t place, const Observer&)>& run,
                   const Context& context);

/// Returns measure(file, observer) of every file, in their order; as for_each_scan().
template <typename Measured, typename Measure>
std::vector<Measured> measure_each(const std::vector<std::string>& files, const std::string& verb,
                                   const Measure& measure, const Context& context) {
  std::vector<Measured> all(files.size());
  for_each_scan(
      files, verb,
      [&](std::size_t place, const Observer& observer) {
        all[place] = measure(files[place], observer);
      },
      context);
  return all;
}

}  // namespace tabor::cli
