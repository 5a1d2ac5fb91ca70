#include "tabor/study/study_keys.hpp"

#include <fmt/format.h>

#include <cmath>
#include <set>

namespace tabor::study {

void reject(const io::Config& config, std::string_view key, const std::string& got,
            const std::string& expected) {
  throw InputError(config.place(key), got, expected, "");
}

double positive(const io::Config& config, std::string_view key, Dimension expected) {
  const double value = config.quantity(key, expected);
  if (!(value > 0) || !std::isfinite(value)) {
    reject(config, key, fmt::format("{}", value), "a value above zero");
  }
  return value;
}

std::vector<double> read_axis(const io::Config& config, std::string_view key, Dimension expected,
                              bool zero_allowed) {
  std::vector<double> values = config.quantities(key, expected);
  std::set<double> seen;
  for (const double value : values) {
    if (!std::isfinite(value) || value < 0 || (value == 0 && !zero_allowed)) {
      reject(config, key, fmt::format("{}", value),
             zero_allowed ? "values of zero or more" : "values above zero");
    }
    if (!seen.insert(value).second) reject(config, key, "the same value twice", "each value once");
  }
  return values;
}

topography::Treatment read_steps(const io::Config& config, std::string_view key) {
  const topography::Treatment steps = config.texts(key);
  try {
    topography::check(steps);
  } catch (const InputError& error) {
    throw InputError(config.place(key) + ": " + error.what());
  }
  return steps;
}

}  // namespace tabor::study
