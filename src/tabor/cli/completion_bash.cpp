#include <fmt/format.h>
#include <fmt/ranges.h>

#include <map>

#include "tabor/cli/completion.hpp"
#include "tabor/cli/explain.hpp"
#include "tabor/cli/reference.hpp"

namespace tabor::cli {

namespace {

using Words = std::vector<std::string>;

std::string in_one(const Words& words) { return fmt::format("'{}'", fmt::join(words, " ")); }

Words spellings_of(const Option& option) {
  return option.short_flag.empty() ? Words{option.flag} : Words{option.short_flag, option.flag};
}

/// What may stand in a place, as assignments of the script.
std::string choice_of(const Option& option) {
  const std::string words = option.words.empty() ? "" : "words=" + in_one(option.words);
  if (!option.is_path()) return words.empty() ? ":" : words;
  return words.empty() ? "files=yes" : words + " files=yes";
}

/// The flags of a verb, and those that the next word belongs to.
std::string flags_line(const Reference& reference) {
  Words flags;
  Words with_value;
  for (const Option& option : reference.options()) {
    for (const std::string& flag : spellings_of(option)) {
      flags.push_back(flag);
      if (!option.is_switch()) with_value.push_back(flag);
    }
  }
  return fmt::format("    {}) flags={} with_value={};;\n", reference.verb.name, in_one(flags),
                     in_one(with_value));
}

std::string place_lines(const Reference& reference) {
  std::string lines;
  int place = 0;
  for (const Option& option : reference.positionals()) {
    const std::string number = option.repeatable ? "[0-9]*" : fmt::format("{}", ++place);
    lines += fmt::format("    '{} '{}) {};;\n", reference.verb.name, number, choice_of(option));
  }
  return lines;
}

/// One line for a flag that has the same choices in all verbs, else one for each choice.
std::string value_lines(const std::vector<Reference>& all) {
  std::map<std::string, std::map<std::string, Words>> verbs;  // by flag and choice
  for (const Reference& reference : all) {
    for (const Option& option : reference.options()) {
      if (option.is_switch()) continue;
      for (const std::string& flag : spellings_of(option)) {
        verbs[flag][choice_of(option)].push_back(fmt::format("'{} {}'", reference.verb.name, flag));
      }
    }
  }
  std::string lines;
  for (const auto& [flag, choices] : verbs) {
    for (const auto& [choice, calls] : choices) {
      const bool is_everywhere = choices.size() == 1;
      lines += fmt::format(
          "    {}) {};;\n",
          is_everywhere ? fmt::format("*' {}'", flag) : fmt::format("{}", fmt::join(calls, "|")),
          choice);
    }
  }
  return lines;
}

// Readline ends a word at each equals sign and colon; replies leave out what stands before the last
// one. Without a reply readline completes names of files itself, with their blanks.
constexpr const char* kProgram = R"(
_tabor() {
  local line typed verb place=1 i flags='' with_value='' words='' files=''
  read -ra line <<<"${COMP_LINE:0:COMP_POINT}"
  [[ ${COMP_LINE:0:COMP_POINT} == *[[:blank:]] ]] && line+=('')
  typed=${line[-1]} verb=${line[1]}
  if ((${#line[@]} == 2)); then
    words=$_tabor_verbs
  else
    _tabor_flags "$verb"
    for ((i = 2; i < ${#line[@]} - 1; i++)); do
      if [[ " $with_value " == *" ${line[i]} "* ]]; then
        i=$((i + 1))
      elif [[ ${line[i]} != -* ]]; then
        place=$((place + 1))
      fi
    done
    if [[ " $with_value " == *" ${line[-2]} "* ]]; then
      _tabor_choices "$verb ${line[-2]}"
    elif [[ $typed == --*=* ]]; then
      _tabor_choices "$verb ${typed%%=*}"
      typed=${typed#*=}
    elif [[ $typed == -* ]]; then
      words=$flags
    else
      _tabor_choices "$verb $place"
    fi
  fi
  mapfile -t COMPREPLY < <(compgen -W "$words" -- "$typed")
  if [[ -z $files ]]; then
    compopt +o default +o bashdefault 2>/dev/null
  elif ((${#COMPREPLY[@]} > 0)); then
    mapfile -t -O "${#COMPREPLY[@]}" COMPREPLY < <(compgen -f -- "$typed")
  fi
  if [[ $typed == *:* && $COMP_WORDBREAKS == *:* ]]; then
    COMPREPLY=("${COMPREPLY[@]#"${typed%"${typed##*:}"}"}")
  fi
}
complete -o default -o bashdefault -F _tabor tabor
)";

}  // namespace

std::string bash_completion() {
  const std::vector<Reference> all = references();
  Words verbs = names_of_verbs();
  verbs.insert(verbs.end(), {"help", kHelp, kVersionFlag, kExplain});
  std::string flags;
  std::string places;
  for (const Reference& reference : all) {
    flags += flags_line(reference);
    places += place_lines(reference);
  }
  for (const Option& option : all.front().options()) {
    if (option.flag != kExplain) continue;  // the one that also stands before a verb
    places += fmt::format("    '{} '1) {};;\n", kExplain, choice_of(option));
  }
  return fmt::format(
             "# Completion of tabor for bash, written by 'tabor completion bash'.\n"
             "_tabor_verbs={}\n\n"
             "# The flags of a verb, and those that take the next word.\n"
             "_tabor_flags() {{\n  case $1 in\n{}  esac\n}}\n\n"
             "# What may stand in a place of a verb, or behind a flag.\n"
             "_tabor_choices() {{\n  case $1 in\n    'help '1) words=$_tabor_verbs;;\n{}{}  "
             "esac\n}}\n",
             in_one(verbs), flags, places, value_lines(all)) +
         kProgram;
}

}  // namespace tabor::cli
