#include "tabor/analysis/findings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "tabor/core/text.hpp"

namespace tabor::analysis {
namespace {

constexpr std::size_t kFew = 4;  // cases that a line names

bool has_digit(std::string_view word) {
  return std::any_of(word.begin(), word.end(), [](char c) { return c >= '0' && c <= '9'; });
}

bool is_length_unit(std::string_view word) {
  while (!word.empty() && (word.back() == ',' || word.back() == ';' || word.back() == ')')) {
    word.remove_suffix(1);
  }
  return word.ends_with('m') && word.size() <= 3;  // nm, um in UTF-8, mm, m
}

/// The sentence without its numbers and their units of length, which differ from scan to scan.
std::string without_numbers(const std::string& text) {
  std::string rest;
  bool after_number = false;
  for (const auto& word : split(text, ' ')) {
    const bool skip = has_digit(word) || (after_number && is_length_unit(word));
    after_number = has_digit(word);
    if (!skip) rest += std::string(word) + ' ';
  }
  return rest;
}

/// A surface, or a film that flows, may have several warnings under one code.
std::string kind_of(const Warning& warning) {
  const About what = about(warning.code);
  return what == About::surface || what == About::flow
             ? warning.code + '\n' + without_numbers(warning.text)
             : warning.code;
}

/// The parts of the case that the warning is about.
std::string label_of(const Case& one, About what) {
  const bool has_pressure = what != About::surface && what != About::film;
  const bool has_density = what != About::surface && what != About::contact;
  std::string label = one.surface;
  const auto add_part = [&label](bool wanted, const std::string& part) {
    if (wanted && !part.empty()) label += (label.empty() ? "" : " ") + part;
  };
  add_part(has_pressure, one.pressure);
  add_part(has_density, one.density);
  add_part(what == About::flow, one.speed);
  return label;
}

/// One reason, with the cases it is met in.
struct Gathered {
  Finding finding;
  double weight = 0;
  std::vector<const Case*> cases;
};

void add_case(const Case& one, const Warning& warning, Gathered& gathered) {
  Finding& finding = gathered.finding;
  const bool is_first = gathered.cases.empty();
  if (is_first || gathered.cases.back() != &one) gathered.cases.push_back(&one);
  if (!is_first && finding.text != warning.text) finding.texts_differ = true;
  if (is_first || warning.weight > gathered.weight) {
    finding.text = warning.text;
    gathered.weight = warning.weight;
  }
}

using Counts = std::map<std::string, std::size_t>;  // of cases, by surface

/// Names the cases; a surface alone where all of its cases are meant.
Finding named(Gathered&& gathered, const Counts& all) {
  Finding finding = std::move(gathered.finding);
  finding.n_cases = gathered.cases.size();
  finding.is_worst = gathered.weight > 0;
  Counts met;
  for (const Case* one : gathered.cases) ++met[one->surface];
  for (const Case* one : gathered.cases) {
    const bool whole = !one->surface.empty() && met[one->surface] == all.at(one->surface);
    const std::string label = whole ? one->surface : label_of(*one, about(finding.code));
    const bool is_new =
        std::find(finding.cases.begin(), finding.cases.end(), label) == finding.cases.end();
    if (!label.empty() && is_new) finding.cases.push_back(label);
  }
  return finding;
}

std::string names_of(const std::vector<std::string>& cases) {
  std::string text;
  for (std::size_t i = 0; i < cases.size() && i < kFew; ++i) {
    text += (i == 0 ? "" : ", ") + cases[i];
  }
  if (cases.size() > kFew) text += fmt::format(" and {} more", cases.size() - kFew);
  return text;
}

}  // namespace

std::vector<Finding> findings_of(const std::vector<Case>& cases) {
  std::vector<Gathered> all;
  std::map<std::string, std::size_t> places;
  Counts of_surface;
  for (const Case& one : cases) {
    ++of_surface[one.surface];
    for (const Warning& warning : one.warnings) {
      const auto [place, is_new] = places.try_emplace(kind_of(warning), all.size());
      if (is_new) {
        all.emplace_back();
        all.back().finding.code = warning.code;
        all.back().finding.n_all = cases.size();
      }
      add_case(one, warning, all[place->second]);
    }
  }
  std::stable_sort(all.begin(), all.end(), [](const Gathered& a, const Gathered& b) {
    return about(a.finding.code) < about(b.finding.code);
  });
  std::vector<Finding> findings;
  findings.reserve(all.size());
  for (Gathered& gathered : all) findings.push_back(named(std::move(gathered), of_surface));
  return findings;
}

std::string line_of(const Finding& finding) {
  std::string where;
  if (!finding.cases.empty() && finding.n_all > 1) {
    const bool everywhere = finding.n_cases == finding.n_all;
    const std::string all =
        finding.n_all == 2 ? " (both cases" : fmt::format(" (all {} cases", finding.n_all);
    where = everywhere ? all : fmt::format(" ({} of {} cases", finding.n_cases, finding.n_all);
    if (finding.texts_differ) where += finding.is_worst ? ", the worst shown" : ", the first shown";
    where += everywhere ? ")" : ": " + names_of(finding.cases) + ")";
  }
  if (finding.code.empty()) return finding.text;
  return fmt::format("{}{} [{}]", finding.text, where, finding.code);
}

}  // namespace tabor::analysis
