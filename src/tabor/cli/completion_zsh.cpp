#include <fmt/format.h>
#include <fmt/ranges.h>

#include "tabor/cli/completion.hpp"
#include "tabor/cli/reference.hpp"

namespace tabor::cli {

namespace {

/// The text with a backslash before each of these characters.
std::string escaped(const std::string& text, const std::string& characters) {
  std::string all;
  for (const char c : text) {
    if (characters.find(c) != std::string::npos) all += '\\';
    all += c;
  }
  return all;
}

std::string quoted(const std::string& text) {
  std::string all = "'";
  for (const char c : text) all += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return all + "'";
}

/// The action of _arguments: words, files, both or nothing.
std::string action_of(const Option& option) {
  const std::string words = escaped(fmt::format("{}", fmt::join(option.words, " ")), ":");
  if (option.words.empty()) return option.is_path() ? "_files" : " ";
  return option.is_path() ? " _tabor_words_or_files " + words : "(" + words + ")";
}

std::string spec_of(const Option& option, const std::string& flag) {
  const std::string help = escaped(first_clause(option.help), "[]:\\");
  const std::string repeats = option.repeatable ? "*" : "";
  if (option.is_switch()) return quoted(fmt::format("{}{}[{}]", repeats, flag, help));
  const char* equals = flag.starts_with("--") ? "=" : "";
  return quoted(fmt::format("{}{}{}[{}]:value:{}", repeats, flag, equals, help, action_of(option)));
}

std::string verb_lines(const Reference& reference) {
  std::string lines = fmt::format("        {})\n          _arguments", reference.verb.name);
  const auto add = [&](const std::string& spec) { lines += " \\\n            " + spec; };
  for (const Option& option : reference.positionals()) {
    const std::string name = escaped(option.flag, ":");
    add(quoted(fmt::format("{}:{}:{}", option.repeatable ? "*" : "", name, action_of(option))));
  }
  for (const Option& option : reference.options()) {
    if (!option.short_flag.empty()) add(spec_of(option, option.short_flag));
    add(spec_of(option, option.flag));
  }
  return lines + ";;\n";
}

}  // namespace

std::string zsh_completion() {
  std::string verbs;
  std::string lines;
  for (const Reference& reference : references()) {
    const Verb& verb = reference.verb;
    verbs += "    " + quoted(verb.name + ':' + first_clause(verb.summary)) + '\n';
    lines += verb_lines(reference);
  }
  return fmt::format(
      "#compdef tabor\n"
      "# Completion of tabor for zsh, written by 'tabor completion zsh'.\n"
      "_tabor_words_or_files() {{\n  compadd -- \"$@\"\n  _files\n}}\n\n"
      "_tabor() {{\n"
      "  local curcontext=$curcontext state line\n"
      "  local -a verbs\n"
      "  verbs=(\n{}    'help:explain a verb'\n  )\n"
      "  _arguments -C '(- *)'{{-h,--help}}'[list the verbs]' "
      "'(- *)'{{-V,--version}}'[print the version]' '1:verb:->verb' '*::word:->words'\n"
      "  case $state in\n"
      "    verb) _describe verb verbs;;\n"
      "    words)\n"
      "      case $words[1] in\n"
      "        help) _describe verb verbs;;\n{}"
      "      esac;;\n"
      "  esac\n"
      "}}\n"
      "_tabor \"$@\"\n",
      verbs, lines);
}

}  // namespace tabor::cli
