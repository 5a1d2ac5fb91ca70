#include "tabor/cli/help.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "tabor/cli/layout.hpp"
#include "tabor/cli/reference.hpp"
#include "tabor/core/version.hpp"

namespace tabor::cli {

namespace {

constexpr std::size_t kIndent = 2;
constexpr std::size_t kHelpColumn = 26;
constexpr std::size_t kPurposeIndent = 8;  // behind continued command lines

/// A name and its explanation beside it, or below where the name is long.
std::string entry(const std::string& name, const std::string& text, std::size_t text_column) {
  std::string lines = std::string(kIndent, ' ') + wrapped_choices(name, kIndent);
  const std::size_t column = width_on_screen(lines);
  const bool is_short = column + 2 <= text_column && lines.find('\n') == std::string::npos;
  lines += is_short ? std::string(text_column - column, ' ') : '\n' + std::string(text_column, ' ');
  return lines + wrapped(text, text_column) + '\n';
}

std::string text_of(const OptionGroup& group) {
  std::string text = fmt::format("\n{}:\n", group.title);
  for (const Option& option : group.options) {
    text += entry(form_of(option), option.help, kHelpColumn);
  }
  return text;
}

std::string text_of(const HelpTable& table) {
  std::string text = fmt::format("\n{}:\n", table.title);
  for (const HelpKey& key : table.keys) {
    const std::string name =
        key.unit.empty() ? key.name : fmt::format("{} ({})", key.name, key.unit);
    const std::string absent = key.when_absent.empty() ? "" : fmt::format(" [{}]", key.when_absent);
    text += entry(name, key.meaning + absent, kHelpColumn);
  }
  return text;
}

/// The explanations begin in one column, behind the longest name.
std::string entries(const std::vector<std::pair<std::string, std::string>>& lines) {
  std::size_t column = 0;
  for (const auto& [name, text] : lines) {
    column = std::max(column, kIndent + width_on_screen(name) + 2);
  }
  std::string all;
  for (const auto& [name, text] : lines) all += entry(name, text, column);
  return all;
}

std::string exit_codes() {
  std::vector<std::string> texts;
  for (const auto& [code, meaning] : kExitMeanings) {
    texts.push_back(fmt::format("{} {}", static_cast<int>(code), meaning));
  }
  return fmt::format("{}", fmt::join(texts, ", "));
}

}  // namespace

const std::vector<FirstStep>& first_steps() {
  static const std::vector<FirstStep> steps{
      {"tabor info SCAN", "show what a scan file contains"},
      {"tabor view SCAN", "try treatment, contact and oil in the browser"},
      {"tabor contact SCAN --level plane --material steel-dc04 --pressure 7MPa",
       "compute the real contact area"},
      {"tabor friction SCAN --level plane --material aluminium-6016 --pressure 7MPa "
       "--density 0.9g/m^2 -o friction.h5",
       "compute friction, dry and with oil, and save the maps"},
      {"tabor report friction.h5", "make a page of the answers and maps"}};
  return steps;
}

std::string greeting() {
  std::string text = wrapped(kWhatItDoes, 0) + "\n\nCommands of a first hour:\n\n";
  for (const FirstStep& step : first_steps()) {
    text += fmt::format("{}\n{}{}\n", shell_lines(step.command), std::string(kPurposeIndent, ' '),
                        step.purpose);
  }
  return text + '\n' +
         wrapped(
             "'tabor --help' lists all commands. 'tabor COMMAND --help' explains one and shows "
             "examples. 'tabor formats' lists the scan files that tabor reads.",
             0) +
         '\n';
}

std::string overview() {
  std::vector<std::pair<std::string, std::string>> lines;
  for (const Verb& verb : verbs()) lines.emplace_back(verb.name, verb.summary);
  return fmt::format(
      "tabor {}\n{}\n\nUsage: tabor VERB [words and options]\n\n{}\n{}\n{}\n", kVersion,
      wrapped(kWhatItDoes, 0), entries(lines),
      wrapped("'tabor VERB --help' explains a verb and shows examples. 'tabor --explain "
              "CODE' explains the warning [CODE]. 'tabor man' and 'tabor completion' "
              "print the manual and completion scripts.",
              0),
      wrapped("Exit codes: " + exit_codes() + ".", 0));
}

std::string help_of(const Verb& verb, const std::string& word) {
  const Reference reference = reference_of(verb);
  const std::string usage = "Usage: ";
  std::string text =
      fmt::format("{}{}\n\n{}\n", usage, wrapped(reference.usage(), 2 * usage.size(), usage.size()),
                  wrapped(verb.summary, 0));
  if (!verb.details.empty()) text += fmt::format("\n{}\n", wrapped(verb.details, 0));
  for (const OptionGroup& group : reference.groups) text += text_of(group);
  for (const HelpTable& table : reference.tables()) {
    if (table.word == word) text += text_of(table);
  }
  text += "\nExamples:\n";
  for (const std::string& example : verb.examples) text += shell_lines(example) + '\n';
  return text;
}

}  // namespace tabor::cli
