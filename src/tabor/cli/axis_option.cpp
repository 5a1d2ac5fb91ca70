#include "tabor/cli/axis_option.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <vector>

#include "tabor/core/error.hpp"
#include "tabor/core/text.hpp"
#include "tabor/core/units.hpp"

namespace tabor::cli {

namespace {

constexpr std::size_t kUsualCount = 5;
constexpr double kMostValues = 10000;

[[noreturn]] void reject(const std::string& text, const std::string& why) {
  throw UsageError(
      fmt::format("--set {}: {}; write KEY=VALUE, a list KEY=V1,V2 or a range like "
                  "ball.speed=0.05m/s..1m/s:log:5",
                  text, why));
}

/// Two numbers around "..", with or without units: "../scan.x3p" is a file.
bool is_range(std::string_view value) {
  const std::size_t dots = value.find("..");
  if (dots == std::string_view::npos) return false;
  const auto begins_with_number = [](std::string_view text) {
    const std::string_view end = trim(text);
    const std::size_t digit = end.find_first_not_of("+-.");
    return digit != std::string_view::npos && digit <= 2 && end[digit] >= '0' && end[digit] <= '9';
  };
  return begins_with_number(value.substr(0, dots)) && begins_with_number(value.substr(dots + 2));
}

/// The values of "65,97,145", one value if there is no list.
std::vector<std::string> listed(const std::string& text, const std::string& value) {
  if (value.find_first_of("\"'[{") != std::string::npos) return {value};
  std::vector<std::string> values;
  for (const std::string& part : split(value, ',')) {
    values.emplace_back(trim(part));
    if (values.back().empty()) reject(text, "a value of the list is missing");
  }
  return values;
}

struct Range {
  std::string begin, end;
  bool is_logarithmic = false;
  std::size_t count = kUsualCount;
};

Range parse_range(const std::string& text, const std::string& value) {
  const std::vector<std::string> parts = split(value, ':');
  Range range;
  const std::size_t dots = parts.front().find("..");
  if (parts.front().find("...") != std::string::npos) {
    reject(text, "three dots; two stand between the ends, and 0.5 begins with its zero");
  }
  range.begin = parts.front().substr(0, dots);
  range.end = parts.front().substr(dots + 2);
  for (std::size_t i = 1; i < parts.size(); ++i) {
    const std::optional<double> count = parse_number(parts[i]);
    if (parts[i] == "log" || parts[i] == "lin") {
      range.is_logarithmic = parts[i] == "log";
    } else if (count && *count >= 2 && *count <= kMostValues && *count == std::floor(*count)) {
      range.count = static_cast<std::size_t>(*count);
    } else {
      reject(text, fmt::format("'{}' is neither log, lin nor a number of values, 2 to {}", parts[i],
                               kMostValues));
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

std::vector<std::string> values_of(const std::string& text, const Range& range) {
  const Quantity begin = parse_quantity(range.begin);
  const Quantity end = parse_quantity(range.end);
  if (!(begin.dimension == end.dimension)) reject(text, "its ends have different units");
  if (range.is_logarithmic && !(begin.value > 0 && end.value > 0)) {
    reject(text, "a logarithmic range needs ends above zero");
  }
  // In the unit of the first end, so that a case reads as its user writes.
  const std::string unit = unit_of(range.begin);
  const double factor = parse_quantity("1" + unit).value;
  std::vector<std::string> values;
  for (std::size_t i = 0; i < range.count; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(range.count - 1);
    const double value = range.is_logarithmic
                             ? begin.value * std::pow(end.value / begin.value, share)
                             : begin.value + share * (end.value - begin.value);
    values.push_back(fmt::format("{:.6g}{}", value / factor, unit));
  }
  return values;
}

}  // namespace

study::SweepAxis parse_axis(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0 || equals + 1 == text.size()) {
    reject(text, "no key or no value");
  }
  study::SweepAxis axis;
  axis.key = std::string(trim(text.substr(0, equals)));
  const std::string value(trim(text.substr(equals + 1)));
  if (!is_range(value)) {
    axis.values = listed(text, value);
    axis.is_range = axis.values.size() > 1;
    return axis;
  }
  axis.is_range = true;
  try {
    axis.values = values_of(text, parse_range(text, value));
  } catch (const InputError& error) {
    reject(text, error.what());
  }
  return axis;
}

}  // namespace tabor::cli
