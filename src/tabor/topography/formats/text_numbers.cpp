#include "tabor/topography/formats/text_numbers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "tabor/core/text.hpp"

namespace tabor::topography::format {
namespace {

constexpr std::string_view kBlanks = " \t\r";

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Words instruments write for a missing height.
bool is_missing(std::string_view field) {
  static constexpr std::string_view words[]{"nan", "-nan", "nm",  "bad",  "inf", "-inf",     "+inf",
                                            "--",  "---",  "***", "null", "n/a", "-nan(ind)"};
  const std::string word = lower(field);
  return std::find(std::begin(words), std::end(words), word) != std::end(words);
}

/// A number with a decimal point or, if told, a decimal comma.
std::optional<double> number(std::string_view field, bool decimal_comma) {
  if (field.starts_with('+')) field.remove_prefix(1);
  std::string replaced;
  if (decimal_comma && field.find(',') != std::string_view::npos) {
    replaced = field;
    std::replace(replaced.begin(), replaced.end(), ',', '.');
    field = replaced;
  }
  double value = 0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (end != field.data() + field.size()) return std::nullopt;
  if (error == std::errc::result_out_of_range) return std::abs(value) < 1 ? 0.0 : kHole;
  return error == std::errc{} ? std::optional(value) : std::nullopt;
}

/// A comma between digits of a blank- or semicolon-separated field can only be a decimal comma if
/// no field has two of them and no point occurs. "1,2" alone on a line stays two fields.
bool has_decimal_commas(std::string_view text) {
  constexpr std::size_t kSample = 16384;
  text = text.substr(0, kSample);
  if (text.find('.') != std::string_view::npos || text.find(',') == std::string_view::npos) {
    return false;
  }
  bool several_fields = false;
  while (!text.empty()) {
    const std::string_view line = trim(take_line(text));
    several_fields |= line.find_first_of(" \t;") != std::string_view::npos;
    std::size_t commas = 0;
    for (std::size_t i = 0; i < line.size(); ++i) {
      if (line[i] == ',') {
        const bool inside =
            i > 0 && i + 1 < line.size() && is_digit(line[i - 1]) && is_digit(line[i + 1]);
        if (!inside || ++commas > 1) return false;
      } else if (line[i] == ' ' || line[i] == '\t' || line[i] == ';') {
        commas = 0;
      }
    }
  }
  return several_fields;
}

/// Splits a line into fields. Blanks separate; so does one hard separator (';' or ','), between two
/// of which an empty field means a missing value.
class Fields {
 public:
  Fields(std::string_view line, bool decimal_comma)
      : line_(trim(line)), hard_(decimal_comma ? ";" : ";,") {}

  bool next(std::string_view& field) {
    if (line_.empty()) return false;
    const std::size_t end =
        std::min(line_.find_first_of(hard_ == ";" ? " \t\r;" : " \t\r;,"), line_.size());
    field = line_.substr(0, end);
    line_.remove_prefix(end);
    skip_blanks();
    if (!line_.empty() && hard_.find(line_.front()) != std::string_view::npos) {
      line_.remove_prefix(1);
      skip_blanks();
    }
    return true;
  }

 private:
  void skip_blanks() {
    line_.remove_prefix(std::min(line_.find_first_not_of(kBlanks), line_.size()));
  }
  std::string_view line_;
  std::string_view hard_;
};

}  // namespace

bool TextNumbers::is_rectangular() const {
  return std::all_of(columns.begin(), columns.end(),
                     [this](std::size_t n) { return n == n_columns(); });
}

std::string_view take_line(std::string_view& text) {
  const std::size_t end = std::min(text.find('\n'), text.size());
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  return line;
}

bool starts_with_number(std::string_view line) {
  std::string_view field;
  if (!Fields(line, true).next(field)) return false;
  if (is_missing(field)) return true;
  const std::size_t comma = field.find(',');
  return number(field, true).has_value() || number(field.substr(0, comma), false).has_value();
}

TextNumbers parse_numbers(const Contents& contents, std::string_view text, std::size_t first_line) {
  const bool decimal_comma = has_decimal_commas(text);
  TextNumbers numbers;
  for (std::size_t line_number = first_line; !text.empty(); ++line_number) {
    Fields fields(take_line(text), decimal_comma);
    std::string_view field;
    const std::size_t before = numbers.values.size();
    while (fields.next(field)) {
      const auto value = number(field, decimal_comma);
      if (!value && !field.empty() && !is_missing(field)) {
        refuse(contents, fmt::format("'{}' on line {}", field.substr(0, 40), line_number),
               "a number", "remove or comment what is not data");
      }
      numbers.values.push_back(value && std::isfinite(*value) ? *value : kHole);
    }
    if (numbers.values.size() == before) continue;
    numbers.columns.push_back(numbers.values.size() - before);
    numbers.lines.push_back(line_number);
  }
  return numbers;
}

}  // namespace tabor::topography::format
