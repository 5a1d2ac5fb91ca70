#pragma once

#include <filesystem>
#include <string>

#include "tabor/io/text/json.hpp"

// Seals files with a digest of their bytes and checks it, so that a flipped bit is found before the
// content is used.
namespace tabor::io {

/// Appends a last line, "tabor-sha256 <64 digits>", the digest of all bytes before it. HDF5 ignores
/// bytes after its own end. Throws OutputError.
void seal(const std::filesystem::path& file);

/// Returns "" if the file ends in such a line that fits its bytes, otherwise the error, beginning
/// with the file's name.
std::string broken_seal(const std::filesystem::path& file);

/// Adds to a JSON object the member "sha256", the digest of the text of the others.
Json sealed(Json object);
/// True where nothing is missing and nothing differs from what was sealed.
bool is_sealed(const Json& object);

}  // namespace tabor::io
