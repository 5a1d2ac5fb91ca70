#include "tabor/record/parameter.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "tabor/core/error.hpp"
#include "tabor/core/text.hpp"

namespace tabor {
namespace {

struct UnitOfDimension {
  Dimension dimension;
  std::string_view unit;
};
constexpr UnitOfDimension kUnits[] = {{dimension::none, ""},
                                      {dimension::length, "m"},
                                      {dimension::wavevector, "1/m"},
                                      {dimension::pressure, "Pa"},
                                      {dimension::areal_density, "kg/m^2"},
                                      {dimension::density, "kg/m^3"},
                                      {dimension::speed, "m/s"},
                                      {dimension::viscosity, "Pa s"},
                                      {dimension::per_pressure, "1/Pa"},
                                      {dimension::pressure_gradient, "Pa/m"},
                                      {dimension::force, "N"},
                                      {dimension::force_per_length, "N/m"},
                                      {dimension::mass_per_length, "kg/m"},
                                      {dimension::mass, "kg"},
                                      {dimension::time, "s"},
                                      {dimension::temperature, "K"}};

/// "kg/m^3" -> "kg_per_m3", "1/Pa" -> "per_Pa", "Pa s" -> "Pa_s".
std::string key_part(const std::string& unit) {
  std::string part;
  for (const char c : unit) {
    if (c == '/') {
      part += part.empty() || part == "1" ? "per_" : "_per_";
    } else if (c == ' ') {
      part += '_';
    } else if (c != '^' && !(c == '1' && part.empty())) {
      part += c;
    }
  }
  return part;
}

/// True if "k" before the unit means a thousand of it: not before kg, 1/Pa and m^2/N.
bool takes_prefix(const std::string& unit) {
  return !unit.starts_with("kg") && !unit.starts_with("1/") && unit.find('^') != 1;
}

}  // namespace

bool Bounds::contain(double value) const {
  if (text.empty()) return true;
  if (std::isinf(value) && value > 0 && infinity_is_in) return true;
  if (!std::isfinite(value) || value > most) return false;
  return least_is_out ? value > least : value >= least;
}

std::string ParameterHead::option() const { return flag.empty() ? option_by_name() : flag; }

std::string ParameterHead::option_by_name() const {
  std::string option = "--" + name;
  std::replace(option.begin(), option.end(), '_', '-');
  return option;
}

std::string ParameterHead::python_argument() const { return argument.empty() ? name : argument; }

std::string ParameterHead::json_key() const {
  const std::string part = key_part(si_unit(dimension));
  return part.empty() ? name : name + "_" + part;
}

std::string ParameterHead::study_table() const {
  const std::size_t dot = study_key.find('.');
  return dot == std::string::npos ? "" : study_key.substr(0, dot);
}

std::string ParameterHead::study_name() const { return study_key.substr(study_key.find('.') + 1); }

bool ParameterHead::is_in_table(std::string_view table) const {
  return !study_key.empty() && study_table() == table;
}

std::string ParameterHead::file_key() const { return study_key.empty() ? name : study_key; }

std::string ParameterHead::in_toml(const std::string& value) const {
  const bool is_quoted = kind == ValueKind::text || !words.empty() || dimension != dimension::none;
  return is_quoted && !value.starts_with('[') ? '"' + value + '"' : value;
}

std::string ParameterHead::sample() const {
  return in_toml(default_text.empty() ? example : default_text);
}

std::string ParameterHead::shown_unit() const { return unit.empty() ? si_unit(dimension) : unit; }

std::string ParameterHead::when_absent() const {
  if (needed == Needed::yes) return "required";
  return default_text.empty() ? absent : default_text;
}

std::string ParameterHead::meaning() const {
  if (!help.empty()) return help;
  return kind == ValueKind::flag ? one_of({"true", "false"}) : one_of(words);
}

bool holds_default(const Cell& cell) {
  if (const auto* number = std::get_if<double>(&cell)) return *number > 0;
  return std::holds_alternative<std::string>(cell) || std::holds_alternative<std::uint64_t>(cell);
}

std::string si_unit(const Dimension& dimension) {
  const auto* const found =
      std::find_if(std::begin(kUnits), std::end(kUnits),
                   [&](const UnitOfDimension& one) { return one.dimension == dimension; });
  return found == std::end(kUnits) ? "" : std::string(found->unit);
}

std::string text_of(double value, const Dimension& dimension) {
  return text_of(value, ParameterHead{.name = "", .dimension = dimension});
}

std::string text_of(double value, const ParameterHead& parameter) {
  if (parameter.dimension == dimension::none) return fmt::format("{}", value);
  if (parameter.dimension == dimension::areal_density) {
    return fmt::format("{:.4g} g/m^2", in_g_per_m2(value));
  }
  const std::string unit = parameter.shown_unit();
  return takes_prefix(unit) ? format_si(value, unit) : fmt::format("{:.4g} {}", value, unit);
}

std::string checked_choice(const std::string& what, std::string word,
                           const std::vector<std::string>& choices) {
  if (std::find(choices.begin(), choices.end(), word) != choices.end()) return word;
  throw InputError(what, "'" + word + "'", one_of(choices) + suggestion(word, choices), "");
}

std::string one_of(const std::vector<std::string>& words) {
  if (words.empty()) return "";
  const auto last = words.end() - 1;
  if (last == words.begin()) return *last;
  return fmt::format("{} or {}", fmt::join(words.begin(), last, ", "), *last);
}

std::string written(const ParameterHead& parameter, const std::vector<double>& numbers,
                    const Cell& value) {
  if (parameter.kind == ValueKind::numbers && !numbers.empty()) {
    std::vector<std::string> texts;
    texts.reserve(numbers.size());
    for (const double number : numbers) texts.push_back('"' + text_of(number, parameter) + '"');
    return fmt::format("[{}]", fmt::join(texts, ", "));
  }
  if (!numbers.empty()) return text_of(numbers.front(), parameter);
  if (const auto* const text = std::get_if<std::string>(&value)) return *text;
  if (const auto* const flag = std::get_if<bool>(&value)) return *flag ? "true" : "false";
  return "";
}

}  // namespace tabor
