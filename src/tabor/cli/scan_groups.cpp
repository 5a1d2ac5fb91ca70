#include "tabor/cli/scan_groups.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>

#include "tabor/core/error.hpp"
#include "tabor/core/glob.hpp"

namespace tabor::cli {

namespace {

ScanGroup parse_group(const std::string& text) {
  const std::size_t at = text.find('=');
  if (at == std::string::npos || at == 0 || at + 1 == text.size()) {
    throw UsageError(
        fmt::format("--group: got '{}'; expected NAME=PATTERN such as 'before=*before*'", text));
  }
  return {text.substr(0, at), text.substr(at + 1)};
}

bool fits_name(const std::string& file, const std::string& pattern) {
  return fits(std::filesystem::path(file).filename().string(), pattern) || fits(file, pattern);
}

GroupMembers& group_of(const std::string& name, std::vector<GroupMembers>& all) {
  const auto known = std::find_if(all.begin(), all.end(),
                                  [&](const GroupMembers& one) { return one.name == name; });
  return known != all.end() ? *known : all.emplace_back(GroupMembers{name, {}});
}

}  // namespace

void declare_groups(OptionSet& set, std::vector<ScanGroup>& groups) {
  set.group("Groups of scans");
  set.add({.flag = "--group",
           .placeholder = "NAME=PATTERN",
           .help = "mean and standard deviation over the scans whose names match, with * and ?, "
                   "e.g. 'before=*before*'; repeat it for more groups",
           .repeatable = true,
           .assign = [&groups](const std::string& text) { groups.push_back(parse_group(text)); }});
}

std::vector<GroupMembers> members_of(const std::vector<ScanGroup>& groups,
                                     const std::vector<std::string>& files) {
  std::vector<GroupMembers> all;
  for (const ScanGroup& group : groups) {
    std::vector<std::size_t>& places = group_of(group.name, all).places;
    bool is_used = false;
    for (std::size_t i = 0; i < files.size(); ++i) {
      if (!fits_name(files[i], group.pattern)) continue;
      is_used = true;
      if (std::find(places.begin(), places.end(), i) == places.end()) places.push_back(i);
    }
    std::sort(places.begin(), places.end());
    if (is_used) continue;
    throw InputError("--group " + group.name,
                     fmt::format("'{}', which no scan fits", group.pattern),
                     fmt::format("a pattern of one of: {}", fmt::join(files, ", ")), "");
  }
  return all;
}

}  // namespace tabor::cli
