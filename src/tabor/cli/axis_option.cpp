#include "tabor/cli/axis_option.hpp"

#include <fmt/format.h>

#include <vector>

#include "tabor/core/error.hpp"
#include "tabor/core/text.hpp"
#include "tabor/core/value_range.hpp"

namespace tabor::cli {

namespace {

[[noreturn]] void reject(const std::string& text, const std::string& why) {
  throw UsageError(
      fmt::format("--set {}: {}; write KEY=VALUE, a list KEY=V1,V2 or a range like "
                  "ball.speed=0.05m/s..1m/s:log:5",
                  text, why));
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

}  // namespace

study::SweepAxis parse_axis(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0 || equals + 1 == text.size()) {
    reject(text, "no key or no value");
  }
  study::SweepAxis axis;
  axis.key = std::string(trim(text.substr(0, equals)));
  const std::string value(trim(text.substr(equals + 1)));
  if (!is_value_range(value)) {
    axis.values = listed(text, value);
    axis.is_range = axis.values.size() > 1;
    return axis;
  }
  axis.is_range = true;
  try {
    axis.values = values_of_range(value);
  } catch (const InputError& error) {
    reject(text, error.what());
  }
  return axis;
}

}  // namespace tabor::cli
