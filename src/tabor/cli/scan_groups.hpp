#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "tabor/cli/options.hpp"

namespace tabor::cli {

/// Scans that belong together: those whose names fit a pattern.
struct ScanGroup {
  std::string name;
  std::string pattern;  ///< of the file name, or of the path as it is given
};

/// Declares --group NAME=PATTERN.
void declare_groups(OptionSet& set, std::vector<ScanGroup>& groups);

/// The scans of one name.
struct GroupMembers {
  std::string name;
  std::vector<std::size_t> places;  ///< among the files, rising
};

/// Patterns of one name are one group. Throws InputError for a pattern that no file fits.
std::vector<GroupMembers> members_of(const std::vector<ScanGroup>& groups,
                                     const std::vector<std::string>& files);

/// What to call scans that stand side by side: file names, or whole paths where names are the same.
std::vector<std::string> headings(const std::vector<std::string>& files);

}  // namespace tabor::cli
