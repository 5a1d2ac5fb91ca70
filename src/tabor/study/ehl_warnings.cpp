#include "tabor/study/ehl_warnings.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "tabor/core/error.hpp"
#include "tabor/core/text.hpp"
#include "tabor/core/units.hpp"
#include "tabor/study/ehl_jobs.hpp"

namespace tabor::study {

namespace {

constexpr std::size_t kMostNames = 8;  // of cases in one line
constexpr std::size_t kLetters = 26;

/// Warnings of one kind.
struct Kind {
  std::string key;
  std::string text;  // of the first case
  bool has_one_text = true;
  bool is_rejection = false;
  std::vector<std::size_t> cases;
};

/// "a", ..., "z", "a1", ...
std::string mark_of(std::size_t i) {
  const std::string letter(1, static_cast<char>('a' + i % kLetters));
  return i < kLetters ? letter : letter + std::to_string(i / kLetters);
}

/// What may stand around a number or its unit in a sentence.
std::string_view without_punctuation(std::string_view word) {
  const std::size_t begin = word.find_first_not_of("([");
  const std::size_t end = word.find_last_not_of(".,;:)]");
  if (begin == std::string_view::npos || end == std::string_view::npos || end < begin) return "";
  return word.substr(begin, end - begin + 1);
}

bool is_unit(std::string_view word) {
  if (word == "%") return true;
  try {
    parse_quantity("1 " + std::string(word));
    return true;
  } catch (const InputError&) {
    return false;
  }
}

Kind& kind_of(const std::string& text, bool is_rejection, std::vector<Kind>& kinds) {
  const std::string key = is_rejection ? "refused" : without_numbers(text);
  const auto known =
      std::find_if(kinds.begin(), kinds.end(), [&](const Kind& kind) { return kind.key == key; });
  if (known != kinds.end()) return *known;
  kinds.push_back({.key = key, .text = text, .is_rejection = is_rejection, .cases = {}});
  return kinds.back();
}

void add_case(const ehl::CaseResult& answer, std::size_t i, std::vector<Kind>& kinds) {
  const bool is_rejection = is_rejected(answer);
  for (const std::string& warning : answer.warnings) {
    const std::string text =
        is_rejection ? answer.scalars.at("refused").get<std::string>() : warning;
    Kind& kind = kind_of(text, is_rejection, kinds);
    kind.has_one_text = kind.has_one_text && kind.text == text;
    if (kind.cases.empty() || kind.cases.back() != i) kind.cases.push_back(i);
  }
}

std::string names_of(const Kind& kind, const EhlCaseNames& names) {
  std::string text = names.key + " = ";
  const std::size_t n_shown = std::min(kMostNames, kind.cases.size());
  for (std::size_t i = 0; i < n_shown; ++i) {
    text += (i > 0 ? ", " : "") + names.values[kind.cases[i]];
  }
  const std::size_t n_more = kind.cases.size() - n_shown;
  return n_more > 0 ? text + fmt::format(" and {} more", n_more) : text;
}

std::string line_of(const Kind& kind, const EhlCaseNames& names) {
  const std::size_t n = names.values.size();
  if (kind.is_rejection) {
    return fmt::format("{} of {} cases are invalid, the first: {} ({})", kind.cases.size(), n,
                       kind.text, names_of(kind, names));
  }
  const std::string who =
      kind.cases.size() == n
          ? fmt::format("all {} cases", n)
          : fmt::format("{} of {} cases ({})", kind.cases.size(), n, names_of(kind, names));
  return fmt::format("{}{}: {}", who, kind.has_one_text ? "" : ", the first", kind.text);
}

}  // namespace

std::string without_numbers(const std::string& text) {
  std::string kept;
  bool is_after_number = false;
  for (const std::string& word : split(text, ' ')) {
    const std::string_view bare = without_punctuation(word);
    const bool is_number = parse_number(bare).has_value();
    if (!is_number && !(is_after_number && is_unit(bare))) kept += word;
    kept += ' ';
    is_after_number = is_number;
  }
  return kept;
}

EhlWarnings gather_warnings(const std::vector<ehl::CaseResult>& answers,
                            const EhlCaseNames& names) {
  std::vector<Kind> kinds;
  for (std::size_t i = 0; i < answers.size(); ++i) add_case(answers[i], i, kinds);
  EhlWarnings warnings{.lines = {}, .marks = std::vector<std::string>(answers.size())};
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    warnings.lines.push_back(fmt::format("[{}] {}", mark_of(k), line_of(kinds[k], names)));
    for (const std::size_t i : kinds[k].cases) {
      std::string& marks = warnings.marks[i];
      marks += (marks.empty() ? "" : " ") + mark_of(k);
    }
  }
  return warnings;
}

}  // namespace tabor::study
