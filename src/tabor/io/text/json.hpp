#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

// Names the type of JSON values, and reads and writes them.
namespace tabor::io {

/// JSON value of nlohmann-json; the keys of an object keep the order they were given in. An access
/// that does not fit (a key of a text, the text of a number) throws Json::exception.
using Json = nlohmann::ordered_json;

/// Returns a number as JSON; NaN and infinity, which JSON has not, become null.
Json number(double value);

/// Returns the value as text; bytes that are not UTF-8 (a file name may hold anything) are
/// replaced. indent < 0 gives one line.
std::string to_text(const Json& json, int indent = 2);

/// Parses a text. Throws InputError with the place of the mistake, also for values nested so deep
/// that no program of ours wrote them.
Json parse_json(std::string_view text);

/// Parses a file. Throws InputError with its name and the place of the mistake.
Json read_json(const std::filesystem::path& file);

}  // namespace tabor::io
