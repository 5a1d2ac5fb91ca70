#include <fmt/format.h>
#include <fmt/ranges.h>

#include "tabor/cli/completion.hpp"
#include "tabor/cli/reference.hpp"

namespace tabor::cli {

namespace {

std::string quoted(const std::string& text) {
  std::string all = "'";
  for (const char c : text) {
    if (c == '\'' || c == '\\') all += '\\';
    all += c;
  }
  return all + "'";
}

/// What may stand in a place: words, files, both or nothing.
std::string choice_of(const Option& option) {
  std::string text = option.is_path() ? " -F" : " -f";
  if (!option.words.empty()) {
    text += " -a " + quoted(fmt::format("{}", fmt::join(option.words, " ")));
  }
  return text;
}

std::string option_line(const std::string& condition, const Option& option) {
  std::string line = condition + " -l " + option.flag.substr(2);
  if (!option.short_flag.empty()) line += " -s " + option.short_flag.substr(1);
  if (!option.is_switch()) line += " -r" + choice_of(option);
  return line + " -d " + quoted(first_clause(option.help)) + '\n';
}

std::string verb_lines(const Reference& reference) {
  const std::string condition =
      fmt::format("complete -c tabor -n '__tabor_verb_is {}'", reference.verb.name);
  std::string lines;
  for (const Option& option : reference.positionals()) {
    lines += condition + choice_of(option) + '\n';
  }
  for (const Option& option : reference.options()) lines += option_line(condition, option);
  return lines;
}

}  // namespace

std::string fish_completion() {
  std::string text =
      "# Completion of tabor for fish, written by 'tabor completion fish'.\n"
      "function __tabor_verb_is\n"
      "    set -l words (commandline -opc)\n"
      "    test (count $words) -gt 1; and test $words[2] = $argv[1]\n"
      "end\n"
      "function __tabor_needs_verb\n"
      "    test (count (commandline -opc)) -eq 1\n"
      "end\n"
      "complete -c tabor -f\n"
      "complete -c tabor -n __tabor_needs_verb -l help -s h -d 'list the verbs'\n"
      "complete -c tabor -n __tabor_needs_verb -l version -s V -d 'print the version'\n";
  const std::vector<Reference> all = references();
  for (const Reference& reference : all) {
    text += fmt::format("complete -c tabor -n __tabor_needs_verb -a {} -d {}\n",
                        reference.verb.name, quoted(first_clause(reference.verb.summary)));
  }
  text += fmt::format("complete -c tabor -n '__tabor_verb_is help' -a '{}'\n",
                      fmt::join(names_of_verbs(), " "));
  for (const Reference& reference : all) text += verb_lines(reference);
  return text;
}

}  // namespace tabor::cli
