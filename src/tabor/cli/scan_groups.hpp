#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "tabor/cli/options.hpp"

// Declares --group NAME=PATTERN and sorts scan files into the named groups.
namespace tabor::cli {

/// Group of scans whose names match a pattern.
struct ScanGroup {
  std::string name;
  std::string pattern;  ///< of the file name, or of the path as it is given
};

/// Declares --group NAME=PATTERN.
void declare_groups(OptionSet& set, std::vector<ScanGroup>& groups);

/// Scans of one group.
struct GroupMembers {
  std::string name;
  std::vector<std::size_t> places;  ///< among the files, rising
};

/// Sorts files into groups; patterns of one name form one group. Throws InputError for a pattern
/// that no file matches.
std::vector<GroupMembers> members_of(const std::vector<ScanGroup>& groups,
                                     const std::vector<std::string>& files);

}  // namespace tabor::cli
