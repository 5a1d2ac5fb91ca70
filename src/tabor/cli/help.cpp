#include "tabor/cli/help.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "tabor/core/version.hpp"

namespace tabor::cli {

namespace {

constexpr std::size_t kHelpColumn = 30;
constexpr std::size_t kScreenWidth = 100;

std::string form_of(const Option& option) {
  std::string form =
      option.short_flag.empty() ? option.flag : option.short_flag + ", " + option.flag;
  if (!option.placeholder.empty()) form += " " + option.placeholder;
  return form;
}

std::string option_line(const Option& option) {
  std::string line = "  " + form_of(option);
  if (line.size() + 2 > kHelpColumn) {
    line += '\n' + std::string(kHelpColumn, ' ');
  } else {
    line.resize(kHelpColumn, ' ');
  }
  return line + wrapped(option.help, kHelpColumn) + '\n';
}

// Markdown reads a bare | inside a table as the end of a cell.
std::string cell(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '|') escaped += '\\';
    escaped += c;
  }
  return escaped;
}

std::string markdown_row(const std::vector<std::string>& cells, bool has_code) {
  std::string line = "|";
  for (const std::string& text : cells) {
    const bool is_code = has_code && &text == &cells.front();
    line += is_code ? fmt::format(" `{}` |", cell(text)) : fmt::format(" {} |", cell(text));
  }
  return line + '\n';
}

std::string markdown_of(const HelpTable& table) {
  std::string text = fmt::format("\n### {}\n\n", table.title);
  text += markdown_row(table.headings, false);
  text += markdown_row(std::vector<std::string>(table.headings.size(), "---"), false);
  for (const auto& row : table.rows) text += markdown_row(row, true);
  return text;
}

/// The first column as wide as it must be, others at most a fifth of the screen; the last one
/// wrapped.
std::string text_of(const HelpTable& table) {
  constexpr std::size_t kWidest = kScreenWidth / 5;
  std::vector<std::size_t> widths(table.headings.size() - 1);
  std::vector<std::vector<std::string>> rows = {table.headings};
  rows.insert(rows.end(), table.rows.begin(), table.rows.end());
  for (const auto& row : rows) {
    for (std::size_t i = 0; i < widths.size(); ++i) {
      const std::size_t size = i == 0 ? row[i].size() : std::min(kWidest, row[i].size());
      widths[i] = std::max(widths[i], size + 2);
    }
  }
  std::string text = fmt::format("\n{}:\n", table.title);
  for (const auto& row : rows) {
    std::string line = "  ";
    std::size_t indent = line.size();
    for (std::size_t i = 0; i < widths.size(); ++i) {
      line += row[i];
      indent += widths[i];
      if (line.size() + 2 > indent) line += '\n' + std::string(indent, ' ');
      line.resize(std::max(line.size(), line.rfind('\n') + 1 + indent), ' ');
    }
    text += line + wrapped(row.back(), indent) + '\n';
  }
  return text;
}

std::string markdown_of(const Verb& verb) {
  std::string text = fmt::format("\n## tabor {}\n\n    tabor {} {}\n\n{}\n", verb.name, verb.name,
                                 verb.arguments, verb.summary);
  if (!verb.details.empty()) text += fmt::format("\n{}\n", verb.details);
  text += "\n| option | meaning |\n|---|---|\n";
  const OptionSet set = options_of(verb);
  for (const Option& option : set.options()) {
    text += fmt::format("| `{}` | {} |\n", cell(form_of(option)), cell(option.help));
  }
  text += "\nExamples:\n\n";
  for (const std::string& example : verb.examples) text += "    " + example + "\n";
  if (!verb.tables) return text;
  for (const HelpTable& table : verb.tables()) text += markdown_of(table);
  return text;
}

}  // namespace

std::string wrapped(const std::string& text, std::size_t indent) {
  std::string result;
  std::size_t column = indent;
  std::size_t begin = 0;
  while (begin < text.size()) {
    const std::size_t end = std::min(text.find(' ', begin), text.size());
    const std::string word = text.substr(begin, end - begin);
    if (column > indent && column + 1 + word.size() > kScreenWidth) {
      result += '\n' + std::string(indent, ' ');
      column = indent;
    } else if (column > indent) {
      result += ' ';
      ++column;
    }
    result += word;
    column += word.size();
    begin = end + 1;
  }
  return result;
}

std::string overview() {
  std::string text = fmt::format(
      "tabor {}: real contact area, lubricant and friction of scanned rough surfaces\n\n"
      "Usage: tabor VERB [words and options]\n\n",
      kVersion);
  for (const Verb& verb : verbs()) text += fmt::format("  {:<10} {}\n", verb.name, verb.summary);
  return text +
         "\n'tabor VERB --help' explains a verb and shows two examples, 'tabor --explain CODE' the "
         "warning [CODE].\n"
         "Exit codes: 0 done, 2 usage, 3 bad input, 4 not converged, 5 cannot write, "
         "130 interrupted.\n";
}

std::string help_of(const Verb& verb, const std::string& word) {
  std::string text = fmt::format("Usage: tabor {} {}\n\n{}\n", verb.name, verb.arguments,
                                 wrapped(verb.summary, 0));
  if (!verb.details.empty()) text += fmt::format("\n{}\n", wrapped(verb.details, 0));
  std::string group;
  const OptionSet set = options_of(verb);
  for (const Option& option : set.options()) {
    if (option.group != group) text += fmt::format("\n{}:\n", option.group);
    group = option.group;
    text += option_line(option);
  }
  text += "\nExamples:\n";
  for (const std::string& example : verb.examples) text += "  " + example + "\n";
  if (!verb.tables) return text;
  for (const HelpTable& table : verb.tables()) {
    if (table.word == word) text += text_of(table);
  }
  return text;
}

std::string options_markdown() {
  std::string text =
      "# Options\n\nWritten by `tabor options`; do not edit by hand.\n\n"
      "Dimensional values carry their unit (`7MPa`, `0.45g/m^2`, `\"0.67 um\"`). Treatment options "
      "act in the order given.\n";
  for (const Verb& verb : verbs()) text += markdown_of(verb);
  return text;
}

}  // namespace tabor::cli
