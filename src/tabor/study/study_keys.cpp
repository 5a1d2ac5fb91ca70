#include "tabor/study/study_keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace tabor::study {
namespace {

/// The key of a setting, or the first key with this name; "" where there is none.
std::string known_key_of(const std::string& name) {
  if (const ParameterHead* const found = cases::find_parameter(name)) return found->study_key;
  for (const std::string& key : known_keys()) {
    if (key == name || key.ends_with("." + name)) return key;
  }
  return "";
}

}  // namespace

void reject(const io::Config& config, std::string_view key, const std::string& got,
            const std::string& expected) {
  throw InputError(config.place(key), got, expected, "");
}

std::vector<double> read_axis(const io::Config& config, std::string_view key,
                              const ParameterHead& parameter) {
  std::vector<double> values = config.quantities(key, parameter.dimension);
  std::set<double> seen;
  for (const double value : values) {
    if (!parameter.bounds.contain(value)) {
      reject(config, key, text_of(value, parameter.dimension), parameter.bounds.text);
    }
    if (!seen.insert(value).second) reject(config, key, "the same value twice", "each value once");
  }
  return values;
}

std::string key_of(std::string_view setting) {
  const std::string known = known_key_of(std::string(setting));
  return known.empty() ? "contact." + std::string(setting) : known;
}

void check(const io::Config& config, const std::optional<cases::Objection>& objection) {
  if (!objection) return;
  const std::string key = key_of(objection->setting);
  const std::string place = config.place(key);
  const std::string remedy = advised(objection->remedy, spelling());
  if (objection->got.empty()) {  // many sentences begin with the key, as the place ends
    const bool says_key = place.ends_with(key) && remedy.starts_with(key + " ");
    throw InputError(says_key ? place + remedy.substr(key.size()) : place + ": " + remedy);
  }
  throw InputError(place, objection->got, objection->expected, remedy);
}

AdviceSpelling spelling() {
  return [](const Advice& advice) -> std::string {
    const std::string& name = advice.setting;
    for (const topography::StepDescription& step : topography::treatment_steps()) {
      if (step.name != name) continue;
      if (step.argument.empty()) return fmt::format("\"{}\"", name);
      return fmt::format("\"{}={}\"", name, advice.value.empty() ? "..." : advice.value);
    }
    std::string key = known_key_of(name);
    if (key.empty() || advice.value.empty()) return key;
    return fmt::format("{} = \"{}\"", key, advice.value);
  };
}

topography::Treatment read_steps(const io::Config& config, std::string_view key) {
  topography::Treatment steps = config.texts(key);
  try {
    topography::check(steps);
  } catch (const InputError& error) {
    throw InputError(config.place(key) + ": " + error.what());
  }
  return topography::expanded(steps);
}

}  // namespace tabor::study
