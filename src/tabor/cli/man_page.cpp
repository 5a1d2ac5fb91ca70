#include "tabor/cli/man_page.hpp"

#include <fmt/format.h>

#include "tabor/cli/help.hpp"
#include "tabor/cli/layout.hpp"
#include "tabor/cli/reference.hpp"
#include "tabor/core/version.hpp"

namespace tabor::cli {

namespace {

/// The text as roff reads it: a bare hyphen would become a dash, and a dot or an apostrophe at the
/// begin of a line a request.
std::string roff(const std::string& text) {
  std::string escaped;
  bool begins_line = true;
  for (const char c : text) {
    if (begins_line && (c == '.' || c == '\'')) escaped += "\\&";
    begins_line = c == '\n';
    if (c == '\\') {
      escaped += "\\e";
    } else if (c == '-') {
      escaped += "\\-";
    } else if (c == '\'') {
      escaped += "\\(aq";
    } else if (c == '^') {
      escaped += "\\(ha";
    } else if (c == '~') {
      escaped += "\\(ti";
    } else {
      escaped += c;
    }
  }
  return escaped;
}

std::string in_quotes(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : roff(text)) quoted += c == '"' ? std::string("\\(dq") : std::string(1, c);
  return quoted + '"';
}

/// "TABOR\-CONTACT": the title of a page.
std::string title(std::string name) {
  for (char& c : name) c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  return roff(name);
}

std::string head(const std::string& name, const std::string& summary) {
  return fmt::format(".TH {} 1 \"\" \"tabor {}\" \"User Commands\"\n.SH NAME\n{} \\- {}\n",
                     title(name), kVersion, roff(name), roff(summary));
}

std::string section(const std::string& heading) {
  return fmt::format(".SH {}\n", in_quotes(heading));
}

/// The name in bold, and its explanation below it.
std::string entry(const std::string& name, const std::string& text) {
  return fmt::format(".TP\n.B {}\n{}\n", in_quotes(name), roff(text));
}

std::string options_of(const Reference& reference) {
  std::string text = section("OPTIONS");
  for (const OptionGroup& group : reference.groups) {
    text += fmt::format(".SS {}\n", in_quotes(group.title));
    for (const Option& option : group.options) text += entry(form_of(option), option.help);
  }
  return text;
}

std::string keys_of(const HelpTable& table) {
  std::string text = section(table.title);
  for (const HelpKey& key : table.keys) {
    const std::string absent = key.when_absent.empty() ? "" : fmt::format(" [{}]", key.when_absent);
    text += entry(key.unit.empty() ? key.name : fmt::format("{} ({})", key.name, key.unit),
                  key.meaning + absent);
  }
  return text;
}

std::string examples(const std::vector<std::string>& commands) {
  std::string text = section("EXAMPLES");
  for (const std::string& command : commands) {
    const char* gap = &command == &commands.front() ? "" : ".PP\n";
    text += fmt::format("{}.nf\n{}\n.fi\n", gap, roff(shell_lines(command)));
  }
  return text;
}

std::string exit_status() {
  std::string text = section("EXIT STATUS");
  for (const auto& [code, meaning] : kExitMeanings) {
    text += entry(fmt::format("{}", static_cast<int>(code)), meaning);
  }
  return text;
}

}  // namespace

ManPage man_page() {
  const char* const name = "tabor";
  std::string text = head(name, "contact, oil and friction of scanned rough surfaces");
  text += section("SYNOPSIS") + ".B tabor\n.I VERB\n[words and options]\n";
  text += section("DESCRIPTION") + roff(kWhatItDoes) + '\n';
  text += section("VERBS");
  for (const Verb& verb : verbs()) text += entry("tabor-" + verb.name + "(1)", verb.summary);
  std::vector<std::string> commands;
  for (const FirstStep& step : first_steps()) commands.push_back(step.command);
  text += examples(commands) + exit_status();
  text += section("FILES") + entry("tabor.toml", "default options, read from the current folder");
  text += section("ENVIRONMENT") +
          entry("TABOR_PYTHON", "the Python interpreter of the verbs report and view");
  return {name, text};
}

ManPage man_page(const Verb& verb) {
  const Reference reference = reference_of(verb);
  const std::string name = "tabor-" + verb.name;
  std::string text = head(name, verb.summary);
  text += section("SYNOPSIS") +
          fmt::format(".B {}\n{}\n", in_quotes("tabor " + verb.name), roff(verb.arguments));
  if (!verb.details.empty()) text += section("DESCRIPTION") + roff(verb.details) + '\n';
  text += options_of(reference);
  for (const HelpTable& table : reference.tables()) text += keys_of(table);
  text += examples(verb.examples) + exit_status() + section("SEE ALSO") + ".BR tabor (1)\n";
  return {name, text};
}

std::vector<ManPage> man_pages() {
  std::vector<ManPage> pages = {man_page()};
  for (const Verb& verb : verbs()) pages.push_back(man_page(verb));
  return pages;
}

}  // namespace tabor::cli
