#include "tabor/core/advice.hpp"

#include <algorithm>
#include <cctype>
#include <optional>

namespace tabor {
namespace {

/// Where in a text a setting stands, its brackets included.
struct Place {
  std::size_t begin = 0;
  std::size_t end = 0;
  Advice advice;
};

bool is_name(std::string_view word) {
  for (const char c : word) {
    if (c != '_' && std::islower(static_cast<unsigned char>(c)) == 0) return false;
  }
  return !word.empty();
}

/// The next one from there on.
std::optional<Place> next_place(std::string_view text, std::size_t from) {
  for (std::size_t begin = text.find('<', from); begin != std::string_view::npos;
       begin = text.find('<', begin + 1)) {
    const std::size_t end = text.find('>', begin);
    if (end == std::string_view::npos) return std::nullopt;
    const std::string_view inside = text.substr(begin + 1, end - begin - 1);
    const std::size_t equals = inside.find('=');
    const std::string_view name = inside.substr(0, equals);
    if (!is_name(name) || inside.find(' ') != std::string_view::npos) continue;
    const std::string_view value =
        equals == std::string_view::npos ? "" : inside.substr(equals + 1);
    return Place{begin, end + 1, {std::string(name), std::string(value)}};
  }
  return std::nullopt;
}

/// True if every setting of a part has a spelling.
bool can_be_said(std::string_view part, const AdviceSpelling& spelling) {
  for (auto place = next_place(part, 0); place; place = next_place(part, place->end)) {
    if (spelling(place->advice).empty()) return false;
  }
  return true;
}

/// Without the brackets whose settings have no spelling.
std::string with_sayable_brackets(std::string text, const AdviceSpelling& spelling) {
  for (std::size_t begin = text.find(" ("); begin != std::string::npos;) {
    const std::size_t end = text.find(')', begin);
    if (end == std::string::npos) break;
    const std::string inside = text.substr(begin, end + 1 - begin);
    if (can_be_said(inside, spelling)) {
      begin = text.find(" (", begin + 1);
    } else {
      text.erase(begin, inside.size());
      begin = text.find(" (", begin);
    }
  }
  return text;
}

/// One clause with its settings spelled; the name of a setting where it has no spelling.
std::string spelled(std::string_view clause, const AdviceSpelling& spelling) {
  std::string said;
  std::size_t from = 0;
  for (auto place = next_place(clause, 0); place; place = next_place(clause, from)) {
    const std::string word = spelling(place->advice);
    said += clause.substr(from, place->begin - from);
    said += word.empty() ? place->advice.setting : word;
    from = place->end;
  }
  said += clause.substr(from);
  return said;
}

}  // namespace

std::vector<Advice> advice_in(std::string_view text) {
  std::vector<Advice> all;
  for (auto place = next_place(text, 0); place; place = next_place(text, place->end)) {
    all.push_back(place->advice);
  }
  return all;
}

std::string advised(std::string_view text, const AdviceSpelling& spelling) {
  constexpr std::string_view kEnd = "; ";
  const std::string whole = with_sayable_brackets(std::string(text), spelling);
  const std::string_view rest = whole;
  std::string said;
  for (std::size_t begin = 0; begin <= rest.size();) {
    const std::size_t end = std::min(rest.find(kEnd, begin), rest.size());
    const std::string_view clause = rest.substr(begin, end - begin);
    if (begin == 0 || can_be_said(clause, spelling)) {
      said += (begin == 0 ? "" : std::string(kEnd)) + spelled(clause, spelling);
    }
    begin = end + kEnd.size();
  }
  return said;
}

std::string as_option(const Advice& advice) {
  std::string option = "--" + advice.setting;
  std::replace(option.begin(), option.end(), '_', '-');
  return advice.value.empty() ? option : option + " " + advice.value;
}

std::string without_advice(std::string_view text) {
  return advised(text, [](const Advice&) { return std::string(); });
}

}  // namespace tabor
