#include "tabor/cli/verb.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>
#include <sstream>

#include "tabor/cli/contact_request.hpp"
#include "tabor/cli/explain.hpp"
#include "tabor/cli/reference.hpp"
#include "tabor/cli/verbs.hpp"
#include "tabor/core/error.hpp"
#include "tabor/core/text.hpp"

namespace tabor::cli {

void Context::warn(const std::string& text) {
  results::Finding of_no_number;
  of_no_number.text = text;
  warn(std::vector{of_no_number});
}

void Context::warn(std::vector<results::Finding> found) {
  if (spelling) results::spell(spelling, found);
  for (const results::Finding& finding : found) {
    const auto says_the_same = [&, line = results::line_of(finding)](const results::Finding& said) {
      return results::line_of(said) == line;
    };
    if (std::none_of(warnings.begin(), warnings.end(), says_the_same)) warnings.push_back(finding);
  }
  results::put_doubts_first(warnings);
}

std::string Context::line_of(const results::Finding& finding) {
  const bool is_doubt = finding.kind() == cases::Class::doubt;
  return (is_doubt ? "warning: " : "note: ") +
         results::fitted(results::line_of(finding), results::kLineLimit);
}

AdviceSpelling spelling_of(const OptionSet& set) {
  std::set<std::string> flags;
  for (const Option& option : set.options()) flags.insert(option.flag);
  return [flags](const Advice& advice) {
    const std::string flag = flag_of(advice.setting);
    if (!flags.contains(flag)) return std::string();
    return advice.value.empty() ? flag : flag + " " + advice.value;
  };
}

std::string Context::spelled(std::string_view message) const {
  return spelling ? advised(message, spelling) : std::string(message);
}

bool Context::has_default(const std::string& flag) const {
  return std::any_of(defaults.begin(), defaults.end(),
                     [&](const auto& used) { return used.first == flag; });
}

namespace {

std::vector<std::string> warning_codes() {
  std::vector<std::string> codes;
  for (const cases::CodeEntry& entry : cases::all_codes()) codes.emplace_back(entry.code);
  return codes;
}

}  // namespace

Observer Context::observer() const { return progress ? progress->observer() : Observer{}; }

const std::vector<Verb>& verbs() {
  static const std::vector<Verb> all = {
      view_verb(),    info_verb(),      convert_verb(), params_verb(),    psd_verb(),
      combine_verb(), generate_verb(),  contact_verb(), lubricate_verb(), friction_verb(),
      slide_verb(),   sweep_verb(),     ehl_verb(),     report_verb(),    table_verb(),
      formats_verb(), materials_verb(), cite_verb(),    options_verb(),   completion_verb(),
      man_verb()};
  return all;
}

std::vector<std::string> names_of_verbs() {
  std::vector<std::string> names;
  for (const Verb& verb : verbs()) names.push_back(verb.name);
  return names;
}

const Verb& find_verb(const std::string& name) {
  for (const Verb& verb : verbs()) {
    if (verb.name == name) return verb;
  }
  if (name.starts_with('-')) {
    throw UsageError(
        fmt::format("'{}' before the verb; options follow it: tabor VERB {}", name, name));
  }
  const std::vector<std::string> names = names_of_verbs();
  throw UsageError(fmt::format("unknown verb: got '{}'; expected {}{}; see 'tabor --help'", name,
                               fmt::join(names, ", "), suggestion(name, names)));
}

void declare_common(OptionSet& set, Context& context) {
  set.group(kCommonOptions);
  static std::optional<std::string> nobody;  // looked for before options are read
  static bool nothing = false;
  set.toggle(kHelp, "show this text", nothing).short_flag = kHelpShort;
  set.toggle(kVersionFlag, "print the version", nothing).short_flag = kVersionShort;
  set.toggle("--json", "print one JSON object and nothing else", context.json);
  set.toggle("--quiet", "show no progress", context.quiet);
  set.text(kExplain, "CODE", "explain the code of a warning and do nothing else", nobody).words =
      warning_codes();
  set.count("--threads", "number of threads; results do not depend on it [all cores]",
            context.threads);
  Option& defaults = set.text("--defaults", "FILE|none",
                              "file of default options [tabor.toml in this folder, if there is "
                              "one]",
                              nobody);
  defaults.words = {"none"};
  defaults.may_name_file = true;
  set.count("--seed", "seed of all random numbers [1]", context.seed);
}

OptionSet options_of(const Verb& verb) {
  std::ostringstream nowhere;
  Context context{.out = nowhere, .err = nowhere};
  OptionSet set;
  verb.declare(set);
  declare_common(set, context);
  // The variables end here; without `assign` nobody can write to them.
  OptionSet described;
  for (Option option : set.options()) {
    option.assign = nullptr;
    described.add(option);
  }
  return described;
}

}  // namespace tabor::cli
