#include "tabor/cli/markdown.hpp"

#include <fmt/format.h>

#include "tabor/cli/reference.hpp"

namespace tabor::cli {

namespace {

// Markdown reads a bare | inside a table as the end of a cell.
std::string cell(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '|') escaped += '\\';
    escaped += c;
  }
  return escaped;
}

std::string markdown_of(const OptionGroup& group) {
  std::string text = fmt::format("\n| {} | |\n|---|---|\n", group.title);
  for (const Option& option : group.options) {
    text += fmt::format("| `{}` | {} |\n", cell(form_of(option)), cell(option.help));
  }
  return text;
}

std::string markdown_of(const HelpTable& table) {
  std::string text = fmt::format(
      "\n### {}\n\n| key | unit | default | meaning |\n|---|---|---|---|\n", table.title);
  for (const HelpKey& key : table.keys) {
    text += fmt::format("| `{}` | {} | {} | {} |\n", cell(key.name), cell(key.unit),
                        cell(key.when_absent), cell(key.meaning));
  }
  return text;
}

std::string markdown_of(const Reference& reference) {
  const Verb& verb = reference.verb;
  std::string text =
      fmt::format("\n## tabor {}\n\n    {}\n\n{}\n", verb.name, reference.usage(), verb.summary);
  if (!verb.details.empty()) text += fmt::format("\n{}\n", verb.details);
  for (const OptionGroup& group : reference.groups) {
    if (group.title != kCommonOptions) text += markdown_of(group);
  }
  text += "\nExamples:\n\n";
  for (const std::string& example : verb.examples) text += "    " + example + "\n";
  for (const HelpTable& table : reference.tables()) text += markdown_of(table);
  return text;
}

}  // namespace

std::string options_markdown() {
  std::string text =
      "# Options\n\nWritten by `tabor options`; do not edit by hand.\n\n"
      "Dimensional values carry their unit (`7MPa`, `0.45g/m^2`, `\"0.67 um\"`). Treatment options "
      "act in the order given. Every verb has the common options.\n";
  const std::vector<Reference> all = references();
  text += markdown_of(all.front().groups.back());
  for (const Reference& reference : all) text += markdown_of(reference);
  return text;
}

}  // namespace tabor::cli
