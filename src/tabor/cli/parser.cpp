// The one file that knows CLI11. It only tells options, values and positional words apart; what a
// value means is the business of the Option that takes it.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <map>

#include "tabor/cli/options.hpp"
#include "tabor/core/error.hpp"
#include "tabor/core/text.hpp"

namespace tabor::cli {

namespace {

using Declared = std::map<const CLI::Option*, const Option*>;

bool names_file_of(const Option& option, const std::string& word) {
  return std::any_of(option.extensions.begin(), option.extensions.end(),
                     [word = lower(word)](const auto& one) { return word.ends_with(one); });
}

/// Options that may stand alone are given the value that they then have.
std::vector<std::string> with_bare_values(const OptionSet& set, std::vector<std::string> words) {
  for (std::size_t i = 0; i < words.size(); ++i) {
    for (const Option& option : set.options()) {
      if (option.if_bare.empty() || words[i] != option.flag) continue;
      if (i + 1 < words.size() && names_file_of(option, words[i + 1])) continue;
      words[i] += "=" + option.if_bare;
    }
  }
  return words;
}

Declared declare(CLI::App& app, const OptionSet& set) {
  Declared declared;
  for (const Option& option : set.options()) {
    const std::string names =
        option.short_flag.empty() ? option.flag : option.short_flag + "," + option.flag;
    CLI::Option* added = option.is_switch() ? app.add_flag(names) : app.add_option(names);
    // Values of a repeated option are all taken here and told apart in assign_in_order(), where
    // an option that cannot be given twice can be rejected by name.
    added->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->allow_extra_args(option.is_positional() && option.repeatable);
    if (option.is_positional() && option.repeatable) added->expected(0, -1);
    if (!option.is_switch()) added->type_name(option.placeholder);  // "1 required UNIT missing"
    declared[added] = &option;
  }
  return declared;
}

std::vector<std::string> flags_of(const OptionSet& set) {
  std::vector<std::string> flags = {"--help"};
  for (const Option& option : set.options()) {
    if (!option.is_positional()) flags.push_back(option.flag);
  }
  return flags;
}

void reject_unknown_words(const CLI::App& app, const OptionSet& set, const std::string& verb) {
  const std::vector<std::string> unknown = app.remaining();
  if (unknown.empty()) return;
  const auto dashed = std::find_if(unknown.begin(), unknown.end(),
                                   [](const std::string& word) { return word.starts_with('-'); });
  if (dashed == unknown.end()) {
    throw UsageError(
        fmt::format("unexpected word '{}'; see 'tabor {} --help'", unknown.front(), verb));
  }
  const std::string flag = dashed->substr(0, dashed->find('='));
  throw UsageError(fmt::format("unknown option '{}'{}; see 'tabor {} --help'", flag,
                               suggestion(flag, flags_of(set)), verb));
}

bool is_given(const std::string& flag, const Declared& declared) {
  return std::any_of(declared.begin(), declared.end(), [&](const auto& pair) {
    return pair.second->flag == flag && pair.first->count() > 0;
  });
}

void require_all(const Declared& declared, const OptionSet& set, const std::string& verb) {
  for (const Option& option : set.options()) {
    if (!option.required || is_given(option.unless, declared)) continue;
    for (const auto& [parsed, wanted] : declared) {
      if (wanted != &option || parsed->count() > 0) continue;
      const std::string form =
          option.placeholder.empty() ? option.flag : option.flag + " " + option.placeholder;
      throw UsageError(fmt::format("{} is missing ({}){}; see 'tabor {} --help'", form, option.help,
                                   option.unless.empty() ? "" : "; or give " + option.unless,
                                   verb));
    }
  }
}

void require_companions(const Declared& declared, const std::string& verb) {
  for (const auto& [parsed, option] : declared) {
    if (parsed->count() == 0 || option->only_with.empty()) continue;
    if (is_given(option->only_with, declared)) continue;
    throw UsageError(
        fmt::format("{} needs {}; see 'tabor {} --help'", option->flag, option->only_with, verb));
  }
}

void assign(const Option& option, const std::string& value) {
  try {
    option.assign(value);
  } catch (const InputError& error) {
    throw UsageError(error.what());
  }
}

// Treatment steps act in the order given, so values are assigned in the order of the command line
// and not, as CLI11 would, in the order of declaration.
void assign_in_order(CLI::App& app, const Declared& declared, bool is_base) {
  std::map<const CLI::Option*, std::size_t> taken;
  for (const CLI::Option* parsed : app.parse_order()) {
    const Option& option = *declared.at(parsed);
    if (option.is_base != is_base) continue;
    const std::size_t position = taken[parsed]++;
    if (position > 0 && !option.repeatable) {
      throw UsageError(fmt::format("{} is given more than once", option.flag));
    }
    if (position < parsed->results().size()) assign(option, parsed->results()[position]);
  }
}

}  // namespace

void parse(const OptionSet& set, const std::string& verb, const std::vector<std::string>& words) {
  CLI::App app;
  app.set_help_flag();  // --help is answered before parsing
  app.allow_extras();
  const Declared declared = declare(app, set);
  try {
    std::vector<std::string> whole = with_bare_values(set, words);
    std::reverse(whole.begin(), whole.end());
    app.parse(std::move(whole));
  } catch (const CLI::ParseError& error) {
    throw UsageError(fmt::format("{}; see 'tabor {} --help'", error.what(), verb));
  }
  reject_unknown_words(app, set, verb);
  require_all(declared, set, verb);
  require_companions(declared, verb);
  for (const bool is_base : {true, false}) assign_in_order(app, declared, is_base);
}

}  // namespace tabor::cli
