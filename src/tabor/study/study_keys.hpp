#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>
#include <string_view>
#include <vector>

#include "tabor/core/error.hpp"
#include "tabor/core/text.hpp"
#include "tabor/io/toml.hpp"
#include "tabor/study/study.hpp"

// What the parts that read a study file share.
namespace tabor::study {

[[noreturn]] void reject(const io::Config& config, std::string_view key, const std::string& got,
                         const std::string& expected);

/// Finite and above zero, in SI.
double positive(const io::Config& config, std::string_view key, Dimension expected);

/// A sweep axis: every value finite, at least (or above) zero, and named once.
std::vector<double> read_axis(const io::Config& config, std::string_view key, Dimension expected,
                              bool zero_allowed);

/// Runs a parser of the modules below and says at which key its complaint arose.
template <typename Parse>
auto at_key(const io::Config& config, std::string_view key, Parse parse) {
  try {
    return parse(config.text(key));
  } catch (const InputError& error) {
    throw InputError(config.place(key) + ": " + error.what());
  }
}

/// A key whose values have names.
template <typename Names>
auto named(const io::Config& config, std::string_view key, const Names& names) {
  const std::string word = config.text(key);
  if (const auto value = names.find(word)) return *value;
  reject(config, key, "'" + word + "'",
         fmt::format("{}", fmt::join(names.all(), " or ")) + suggestion(word, names.all()));
}

/// A chain of treatment steps that exist.
topography::Treatment read_steps(const io::Config& config, std::string_view key);

/// The [[scan]] tables; file names are relative to `folder`.
void read_scans(const io::Config& config, const std::filesystem::path& folder, Study& study);

/// lubricant.fluid and what belongs to it.
void read_flowing_oil(const io::Config& config, Study& study);

}  // namespace tabor::study
