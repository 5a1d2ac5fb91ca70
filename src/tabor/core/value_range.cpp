#include "tabor/core/value_range.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "tabor/core/error.hpp"
#include "tabor/core/text.hpp"
#include "tabor/core/units.hpp"

namespace tabor {
namespace {

constexpr std::size_t kDefaultCount = 5;
constexpr double kMostValues = 10000;

struct Range {
  std::string begin, end;
  bool is_logarithmic = false;
  std::size_t count = kDefaultCount;
};

Range parse_range(std::string_view text) {
  const std::vector<std::string> parts = split(text, ':');
  Range range;
  const std::string& ends = parts.front();
  if (ends.find("...") != std::string::npos) {
    throw InputError(fmt::format(
        "'{}' has three dots; write two between the ends, and 0.5 with its zero", text));
  }
  const std::size_t dots = ends.find("..");
  range.begin = ends.substr(0, dots);
  range.end = ends.substr(dots + 2);
  for (std::size_t i = 1; i < parts.size(); ++i) {
    const std::optional<double> count = parse_number(parts[i]);
    if (parts[i] == "log" || parts[i] == "lin") {
      range.is_logarithmic = parts[i] == "log";
    } else if (count && *count >= 2 && *count <= kMostValues && *count == std::floor(*count)) {
      range.count = static_cast<std::size_t>(*count);
    } else {
      throw InputError(fmt::format("'{}' is neither log, lin nor a number of values, 2 to {}",
                                   parts[i], kMostValues));
    }
  }
  return range;
}

/// What stands behind the number of "0.05 m/s", with a blank before it.
std::string unit_of(const std::string& value) {
  const std::size_t digits = value.find_last_of("0123456789.");
  std::size_t begin = 0;  // behind the longest number at the start
  for (std::size_t length = 1; length <= digits + 1 && length <= value.size(); ++length) {
    if (parse_number(trim(value.substr(0, length)))) begin = length;
  }
  const std::string unit(trim(value.substr(begin)));
  return unit.empty() ? "" : " " + unit;
}

bool begins_with_number(std::string_view text) {
  const std::string_view end = trim(text);
  const std::size_t digit = end.find_first_not_of("+-.");
  return digit != std::string_view::npos && digit <= 2 && end[digit] >= '0' && end[digit] <= '9';
}

}  // namespace

bool is_value_range(std::string_view text) {
  const std::size_t dots = text.find("..");
  return dots != std::string_view::npos && begins_with_number(text.substr(0, dots)) &&
         begins_with_number(text.substr(dots + 2));
}

std::vector<std::string> values_of_range(std::string_view text) {
  const Range range = parse_range(text);
  const Quantity begin = parse_quantity(range.begin);
  const Quantity end = parse_quantity(range.end);
  if (!(begin.dimension == end.dimension)) {
    throw InputError(fmt::format("the ends of '{}' have different units", text));
  }
  if (range.is_logarithmic && !(begin.value > 0 && end.value > 0)) {
    throw InputError("a logarithmic range needs ends above zero");
  }
  // In the unit of the first end, so that a case reads as its user writes.
  const std::string unit = unit_of(range.begin);
  const double factor = parse_quantity("1" + unit).value;
  std::vector<std::string> values;
  values.reserve(range.count);
  for (std::size_t i = 0; i < range.count; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(range.count - 1);
    const double value = range.is_logarithmic
                             ? begin.value * std::pow(end.value / begin.value, share)
                             : begin.value + share * (end.value - begin.value);
    values.push_back(fmt::format("{:.6g}{}", value / factor, unit));
  }
  return values;
}

}  // namespace tabor
