#pragma once

#include <string>
#include <string_view>

#include "tabor/io/text/json.hpp"

// Reads YAML text as the JSON value that it stands for.
namespace tabor::io {

/// Parses the first document of a YAML text: mappings, lists and scalars. Plain scalars become
/// numbers, truth values and null by the rules of YAML 1.2's core schema, quoted ones text; tags
/// are ignored, aliases repeat what they name. `name` is what messages call the text. Throws
/// InputError for text that is no YAML, nested more than 100 deep, or of more than 1e6 values,
/// aliases and what they name included.
Json parse_yaml(std::string_view text, const std::string& name);

}  // namespace tabor::io
