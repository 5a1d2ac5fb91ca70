#include "tabor/cli/explain.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "tabor/cli/layout.hpp"
#include "tabor/cli/result.hpp"
#include "tabor/core/error.hpp"
#include "tabor/core/text.hpp"
#include "tabor/results/explanations.hpp"

namespace tabor::cli {

namespace {

using Words = std::vector<std::string>;

const std::string kWithValue = std::string(kExplain) + "=";

bool is_explain(const std::string& word) {
  return word == kExplain || word.starts_with(kWithValue);
}

std::string code_in(const Words& words) {
  const auto word = std::find_if(words.begin(), words.end(), is_explain);
  std::string code = word->starts_with(kWithValue) ? word->substr(kWithValue.size()) : "";
  if (code.empty() && word + 1 != words.end()) code = *(word + 1);
  if (code.starts_with('[') && code.ends_with(']')) code = code.substr(1, code.size() - 2);
  return code;
}

std::string text_of(const results::Explanation& entry) {
  const char* kind = cases::name_of(cases::class_of(entry.code));
  std::string text = fmt::format("{} ({}, {})\n\n{}\n", entry.code, kind, lower(entry.about),
                                 wrapped("When: " + entry.when, 0));
  if (!entry.what_to_do.empty()) {
    text += fmt::format("\n{}\n", wrapped("What to do: " + entry.what_to_do, 0));
  }
  return text;
}

}  // namespace

bool asks_to_explain(const Words& words) {
  return std::any_of(words.begin(), words.end(), is_explain);
}

int explain(const Words& words, Context& context) {
  const std::string code = code_in(words);
  const results::Explanation* entry = results::explanation_of(code);
  if (entry == nullptr) {
    Words codes;
    for (const cases::CodeEntry& one : cases::all_codes()) codes.emplace_back(one.code);
    throw UsageError(
        fmt::format("{}: got '{}'; expected the code of a warning, such as {}; "
                    "docs/warnings.md lists all{}",
                    kExplain, code, codes.front(), suggestion(code, codes)));
  }
  io::Json object = json_head(context);
  object.update({{"code", entry->code},
                 {"class", cases::name_of(cases::class_of(entry->code))},
                 {"when", entry->when},
                 {"what_to_do", entry->what_to_do}});
  return finish(context, object, text_of(*entry));
}

}  // namespace tabor::cli
