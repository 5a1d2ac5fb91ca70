#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tabor/cases/parameters.hpp"
#include "tabor/core/advice.hpp"
#include "tabor/core/error.hpp"
#include "tabor/core/text.hpp"
#include "tabor/io/text/toml.hpp"
#include "tabor/record/settings_file.hpp"
#include "tabor/study/study.hpp"

// Reads single keys of a study file and reports errors with file, line and key.
namespace tabor::study {

[[noreturn]] void reject(const io::Config& config, std::string_view key, const std::string& got,
                         const std::string& expected);

/// Reads a sweep axis at a key: every value must lie within the bounds of its parameter and occur
/// once.
std::vector<double> read_axis(const io::Config& config, std::string_view key,
                              const ParameterHead& parameter);

/// Returns the key of a setting: "contact.tolerance" for "tolerance".
std::string key_of(std::string_view setting);

/// Throws the objection, if any, with the place of its key.
void check(const io::Config& config, const std::optional<cases::Objection>& objection);

/// Runs a parser of a lower module and adds the place of the key to its errors.
template <typename Parse>
auto at_key(const io::Config& config, std::string_view key, Parse parse) {
  const std::string value = config.text(key);
  try {
    return parse(value);
  } catch (const InputError& error) {
    throw InputError(config.place(key) + ": " + error.what());
  }
}

/// Reads a key whose values have names.
template <typename Names>
auto named(const io::Config& config, std::string_view key, const Names& names) {
  const std::string word = config.text(key);
  if (const auto value = names.find(word)) return *value;
  reject(config, key, "'" + word + "'",
         fmt::format("{}", fmt::join(names.all(), " or ")) + suggestion(word, names.all()));
}

/// Returns the spelling of advice in a study file: "level=plane" as a step, contact.boundary =
/// "free".
AdviceSpelling spelling();

/// Reads a chain of treatment steps, which must exist.
topography::Treatment read_steps(const io::Config& config, std::string_view key);

/// Reads the [[scan]] tables; file names are relative to `folder`.
void read_scans(const io::Config& config, const std::filesystem::path& folder, Study& study);

/// Checks the keys of oil that flows, and reads its speeds.
void read_flowing_oil(const io::Config& config, Study& study);

}  // namespace tabor::study
