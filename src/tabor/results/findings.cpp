#include "tabor/results/findings.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <utility>

#include "tabor/core/text.hpp"

namespace tabor::results {
namespace {

constexpr std::size_t kFew = 4;  // cases that a line names

/// Tells warnings that are said once for several cases. A reader may say several things of one
/// file; results of earlier versions have warnings without a code.
std::string kind_of(const Warning& warning) {
  const bool has_many_texts =
      warning.code.empty() || warning.code == "file" || warning.code == "override";
  return has_many_texts ? warning.code + '\n' + warning.text : warning.code;
}

/// The parts of the case that the warning is about.
std::string label_of(const Case& one, cases::About what) {
  const bool has_pressure = what != cases::About::surface && what != cases::About::film;
  const bool has_density = what != cases::About::surface && what != cases::About::contact;
  std::string label = one.surface;
  const auto add_part = [&label](bool wanted, const std::string& part) {
    if (wanted && !part.empty()) label += (label.empty() ? "" : " ") + part;
  };
  add_part(has_pressure, one.pressure);
  add_part(has_density, one.density);
  add_part(what == cases::About::flow, one.speed);
  add_part(true, one.name);
  return label;
}

/// A case and how bad it is.
struct Met {
  const Case* one = nullptr;
  double weight = 0;
};

/// One reason, with the cases it is met in.
struct Gathered {
  Finding finding;
  double weight = 0;
  std::vector<Met> cases;
};

void add_case(const Case& one, const Warning& warning, Gathered& gathered) {
  Finding& finding = gathered.finding;
  const bool is_first = gathered.cases.empty();
  if (is_first || gathered.cases.back().one != &one) gathered.cases.push_back({&one, 0});
  double& weight_here = gathered.cases.back().weight;
  weight_here = std::max(weight_here, warning.weight);
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
  std::stable_sort(gathered.cases.begin(), gathered.cases.end(),
                   [](const Met& a, const Met& b) { return a.weight > b.weight; });
  Counts met;
  for (const Met& at : gathered.cases) ++met[at.one->surface];
  for (const Met& at : gathered.cases) {
    const Case& one = *at.one;
    const bool whole = !one.surface.empty() && met[one.surface] == all.at(one.surface);
    const std::string label = whole ? one.surface : label_of(one, cases::about(finding.code));
    const bool is_new =
        std::find(finding.cases.begin(), finding.cases.end(), label) == finding.cases.end();
    if (!label.empty() && is_new) finding.cases.push_back(label);
  }
  return finding;
}

std::string names_of(const std::vector<std::string>& cases, std::size_t n_most) {
  std::string text;
  for (std::size_t i = 0; i < cases.size() && i < n_most; ++i) {
    text += (i == 0 ? "" : ", ") + cases[i];
  }
  if (cases.size() > n_most) text += fmt::format(" and {} more", cases.size() - n_most);
  return text;
}

/// " (2 of 8 cases, the worst shown: 7 MPa, 2 MPa)" with that many names.
std::string where_of(const Finding& finding, std::size_t n_names) {
  if (finding.cases.empty() || finding.n_all < 2) return "";
  const bool everywhere = finding.n_cases == finding.n_all;
  std::string where = !everywhere ? fmt::format("{} of {} cases", finding.n_cases, finding.n_all)
                      : finding.n_all == 2 ? std::string("both cases")
                                           : fmt::format("all {} cases", finding.n_all);
  if (finding.texts_differ) where += finding.is_worst ? ", the worst shown" : ", the first shown";
  if (!everywhere && n_names > 0) where += ": " + names_of(finding.cases, n_names);
  return " (" + where + ")";
}

std::string in_brackets(const std::string& code) { return " [" + code + "]"; }

bool is_before(const Finding& a, const Finding& b) { return a.kind() < b.kind(); }

/// The last folders of a path and its name.
std::string end_of(const std::string& path, std::size_t n_folders) {
  std::size_t begin = path.size();
  for (std::size_t i = 0; i <= n_folders && begin != std::string::npos && begin > 0; ++i) {
    begin = path.rfind('/', begin - 1);
  }
  return begin == std::string::npos ? path : path.substr(begin + 1);
}

/// True if the word is the path of a file in a folder: "cases/ball.toml:", not "g/m^2".
bool is_path(std::string_view word) {
  const std::size_t slash = word.rfind('/');
  const std::size_t dot = word.rfind('.');
  return slash != std::string_view::npos && dot != std::string_view::npos && dot > slash + 1 &&
         dot + 1 < word.size() && std::isalpha(static_cast<unsigned char>(word[dot + 1])) != 0;
}

/// The text with at most so many folders before the names of files.
std::string with_folders(const std::string& text, std::size_t n_folders) {
  std::string shorter;
  for (const std::string& word : split(text, ' ')) {
    if (!shorter.empty()) shorter += ' ';
    shorter += is_path(word) ? end_of(word, n_folders) : word;
  }
  return shorter;
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
    return std::pair(a.finding.kind(), cases::about(a.finding.code)) <
           std::pair(b.finding.kind(), cases::about(b.finding.code));
  });
  std::vector<Finding> findings;
  findings.reserve(all.size());
  for (Gathered& gathered : all) findings.push_back(named(std::move(gathered), of_surface));
  return findings;
}

void put_doubts_first(std::vector<Finding>& findings) {
  std::stable_sort(findings.begin(), findings.end(), is_before);
}

void spell(const AdviceSpelling& spelling, std::vector<Finding>& findings) {
  for (Finding& finding : findings) finding.text = advised(finding.text, spelling);
}

std::string statement_of(const Finding& finding) {
  if (finding.code.empty()) return finding.text;
  const std::size_t limit = kLineLimit - in_brackets(finding.code).size();
  for (std::size_t n_names = kFew; n_names > 0; --n_names) {
    std::string statement = finding.text + where_of(finding, n_names);
    if (statement.size() <= limit) return statement;
  }
  const std::string where = where_of(finding, 0);
  return shortened(finding.text, limit - where.size()) + where;
}

std::string line_of(const Finding& finding) {
  return finding.code.empty() ? finding.text : statement_of(finding) + in_brackets(finding.code);
}

std::string codes_text(const Warnings& warnings) {
  return fmt::format("{}", fmt::join(codes_of(warnings), " "));
}

std::string shortened(const std::string& text, std::size_t limit) {
  constexpr std::string_view kMore = " ...";
  if (text.size() <= limit) return text;
  std::string remedy = text.substr(std::min(text.rfind("; "), text.size()));
  if (remedy.size() > limit / 2) remedy.clear();  // what is wrong must be said, too
  const std::size_t end = text.rfind(' ', limit - kMore.size() - remedy.size());
  return text.substr(0, end == std::string::npos ? 0 : end) + std::string(kMore) + remedy;
}

std::string fitted(const std::string& text, std::size_t limit) {
  constexpr std::size_t kMostFolders = 1;  // it may tell files of one name apart
  std::string shorter = text;
  for (std::size_t n = kMostFolders + 1; n-- > 0 && shorter.size() > limit;) {
    shorter = with_folders(text, n);
  }
  return shortened(shorter, limit);
}

void shorten_paths(std::vector<Case>& cases) {
  std::map<std::string, std::string> names;
  for (const Case& one : cases) names[one.surface] = one.surface;
  for (auto& [path, name] : names) {
    const auto is_told_apart = [&, own = std::string_view(path)](std::size_t n_folders) {
      return std::none_of(names.begin(), names.end(), [&](const auto& other) {
        return other.first != own &&
               end_of(other.first, n_folders) == end_of(std::string(own), n_folders);
      });
    };
    const auto n_folders = static_cast<std::size_t>(std::count(path.begin(), path.end(), '/'));
    for (std::size_t n = 0; n < n_folders && name == path; ++n) {
      if (is_told_apart(n)) name = end_of(path, n);
    }
  }
  for (Case& one : cases) one.surface = names.at(one.surface);
}

}  // namespace tabor::results
