#include "tabor/core/text.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <numeric>

namespace tabor {
namespace {

/// Levenshtein distance.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t above = row[j];
      const std::size_t substitution = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({row[j - 1] + 1, above + 1, substitution});
      diagonal = above;
    }
  }
  return row.back();
}

/// To a whole candidate, or, one more, to its first words: "steel" is near to "steel-dc04".
std::size_t distance_to(std::string_view word, std::string_view candidate) {
  std::size_t distance = edit_distance(word, candidate);
  for (std::size_t end = candidate.find('-'); end != std::string_view::npos;
       end = candidate.find('-', end + 1)) {
    const std::string_view first = candidate.substr(0, end);
    if (first.find_first_not_of('-') == std::string_view::npos) continue;
    distance = std::min(distance, edit_distance(word, first) + 1);
  }
  return distance;
}

bool is_space(char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; }

}  // namespace

std::vector<std::string> split(std::string_view text, char separator) {
  std::vector<std::string> parts;
  std::size_t begin = 0;
  while (true) {
    const std::size_t end = text.find(separator, begin);
    parts.emplace_back(text.substr(begin, end - begin));
    if (end == std::string_view::npos) return parts;
    begin = end + 1;
  }
}

std::string_view trim(std::string_view text) {
  while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
  return text;
}

std::string lower(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return result;
}

std::optional<double> parse_number(std::string_view text) {
  text = trim(text);
  if (text.starts_with('+')) {
    text.remove_prefix(1);  // std::from_chars takes no plus sign
    if (text.starts_with('-')) return std::nullopt;
  }
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::optional<std::string> nearest_match(std::string_view word,
                                         const std::vector<std::string>& candidates) {
  std::optional<std::string> best;
  std::size_t best_distance = std::max<std::size_t>(2, word.size() / 3) + 1;
  for (const std::string& candidate : candidates) {
    const std::size_t distance = distance_to(lower(word), lower(candidate));
    const bool is_alike = distance < std::max(word.size(), candidate.size());  // a letter or more
    if (is_alike && distance < best_distance) {
      best_distance = distance;
      best = candidate;
    }
  }
  return best;
}

std::string suggestion(std::string_view word, const std::vector<std::string>& candidates) {
  const auto match = nearest_match(word, candidates);
  return match ? "; did you mean '" + *match + "'?" : "";
}

std::string yes_no(bool value) { return value ? "yes" : "NO"; }

}  // namespace tabor
