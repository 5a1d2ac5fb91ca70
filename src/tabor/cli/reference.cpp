#include "tabor/cli/reference.hpp"

#include <algorithm>

namespace tabor::cli {

namespace {

OptionGroup& group_of(const std::string& title, std::vector<OptionGroup>& groups) {
  const auto found = std::find_if(groups.begin(), groups.end(),
                                  [&](const OptionGroup& one) { return one.title == title; });
  return found != groups.end() ? *found : groups.emplace_back(OptionGroup{title, {}});
}

std::vector<Option> selected(const std::vector<OptionGroup>& groups, bool positional) {
  std::vector<Option> all;
  for (const OptionGroup& group : groups) {
    for (const Option& option : group.options) {
      if (option.is_positional() == positional) all.push_back(option);
    }
  }
  return all;
}

}  // namespace

std::string Reference::usage() const {
  return "tabor " + verb.name + (verb.arguments.empty() ? "" : " " + verb.arguments);
}

std::vector<HelpTable> Reference::tables() const {
  return verb.tables ? verb.tables() : std::vector<HelpTable>();
}

std::vector<Option> Reference::positionals() const { return selected(groups, true); }
std::vector<Option> Reference::options() const { return selected(groups, false); }

Reference reference_of(const Verb& verb) {
  Reference reference{.verb = verb, .groups = {}};
  const OptionSet set = options_of(verb);
  for (const Option& option : set.options()) {
    group_of(option.group, reference.groups).options.push_back(option);
  }
  return reference;
}

std::vector<Reference> references() {
  std::vector<Reference> all;
  for (const Verb& verb : verbs()) all.push_back(reference_of(verb));
  return all;
}

std::string form_of(const Option& option) {
  std::string form =
      option.short_flag.empty() ? option.flag : option.short_flag + ", " + option.flag;
  if (!option.placeholder.empty()) form += " " + option.placeholder;
  return form;
}

}  // namespace tabor::cli
