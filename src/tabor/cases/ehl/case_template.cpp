#include <fmt/format.h>

#include <algorithm>

#include "tabor/cases/ehl/program.hpp"

namespace tabor::ehl {

namespace {

/// "[m; required] R, radius of a ball".
std::string explanation(const ParameterHead& key) {
  std::string facts = key.shown_unit();
  const std::string absent = key.when_absent();
  if (!absent.empty()) facts += (facts.empty() ? "" : "; ") + absent;
  if (facts.empty()) return key.meaning();
  return fmt::format("[{}] {}", facts, key.meaning());
}

/// One table of the file: "[ball]" and its keys.
struct Section {
  std::string name;
  std::string lines;
  bool is_used = false;  ///< by the example
};

/// Section and word of "roughness.bump.height".
std::pair<std::string, std::string> parts_of(const std::string& key) {
  const std::size_t dot = key.rfind('.');
  return {key.substr(0, dot), key.substr(dot + 1)};
}

void add_line(const ParameterHead& key, const std::string& word, const Example& example,
              Section& section) {
  const auto set = std::find_if(example.begin(), example.end(),
                                [&](const auto& one) { return one.first == key.name; });
  const bool is_set = set != example.end();
  section.is_used |= is_set;
  const std::string setting =
      fmt::format("{}{} = {}", is_set ? "" : "# ", word, is_set ? set->second : key.sample());
  section.lines += fmt::format("{:<34} # {}\n", setting, explanation(key));
}

/// In the order in which they first appear.
std::vector<Section> sections_of(const Program& program) {
  std::vector<Section> sections;
  sections.reserve(program.keys.size());
  for (const ParameterHead& key : program.keys) {
    const auto [name, word] = parts_of(key.name);
    auto at = std::find_if(sections.begin(), sections.end(),
                           [name = name](const Section& one) { return one.name == name; });
    if (at == sections.end()) at = sections.insert(at, {name, "", false});
    add_line(key, word, program.example, *at);
  }
  return sections;
}

}  // namespace

std::string case_template(const Program& program) {
  std::string text = fmt::format(
      "# A case of 'tabor ehl {}': {}.\n# Behind each key stand its unit and, after a semicolon, "
      "what is taken if the key is left out.\n",
      program.name, program.summary);
  for (const Section& section : sections_of(program)) {
    text += fmt::format("\n{}[{}]\n{}", section.is_used ? "" : "# ", section.name, section.lines);
  }
  return text;
}

}  // namespace tabor::ehl
