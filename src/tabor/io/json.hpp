#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

namespace tabor::io {

/// Keys keep the order they were given in. The only file that knows nlohmann-json.
using Json = nlohmann::ordered_json;

/// JSON has no NaN and no infinity: they become null.
Json number(double value);

/// The object as text: dump() throws on text that is not UTF-8 (a file name may hold anything),
/// this replaces such bytes. indent < 0 gives one line.
std::string to_text(const Json& json, int indent = 2);

/// Parses a file; InputError with the place of the mistake.
Json read_json(const std::filesystem::path& file);

}  // namespace tabor::io
