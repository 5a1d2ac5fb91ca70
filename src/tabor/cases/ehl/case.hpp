#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "tabor/cases/ehl/program.hpp"
#include "tabor/core/error.hpp"
#include "tabor/io/text/toml.hpp"

/// What the cases of all elastohydrodynamic programs have in common.
namespace tabor::ehl {

/// Runs a function of the modules below and says at which key its complaint arose.
template <typename Run>
auto at_key(const io::Config& file, std::string_view key, Run run) {
  try {
    return run();
  } catch (const InputError& error) {
    throw InputError(file.place(key) + ": " + error.what());
  }
}

/// The value of a setting that others make necessary. Throws InputError where it is missing.
template <typename Value>
const Value& required(const std::optional<Value>& value, const io::Config& file,
                      std::string_view key) {
  if (value) return *value;
  throw InputError(file.place(key) + " is missing");
}

/// Throw InputError for a setting beside one that takes its place, or without one that belongs to
/// it.
[[noreturn]] void reject_beside(const io::Config& file, std::string_view key,
                                const std::string& other, const std::string& remedy = "");
[[noreturn]] void reject_without(const io::Config& file, std::string_view key,
                                 const std::string& other, const std::string& remedy = "");

/// A key that means nothing without another one.
struct LoneKey {
  const char* name;
  const char* needed;
};

/// Throws InputError for the first of these keys that the file has without the one it needs.
void reject_lone(const io::Config& file, std::span<const LoneKey> keys);

/// The file that a key names, from where the case lies.
std::filesystem::path named_file(const io::Config& config, std::string_view key);

/// What makes the surface that a key asks for. Throws InputError where the setting has nothing.
const SurfaceSource& with_source(const io::Config& config, std::string_view key,
                                 const CaseSetting& setting);

}  // namespace tabor::ehl
