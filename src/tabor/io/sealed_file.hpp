#pragma once

#include <filesystem>
#include <string>

#include "tabor/io/json.hpp"

// Files that say what their bytes should be: a bit that a disk, a memory or a copy turned over is
// found before anything is believed.
namespace tabor::io {

/// Appends a last line, "tabor-sha256 <64 digits>", of all bytes before it. HDF5 does not mind what
/// stands behind its own end. Throws OutputError.
void seal(const std::filesystem::path& file);

/// "" if the file ends in such a line and its bytes are those it was made of, otherwise why not,
/// beginning with the file's name.
std::string broken_seal(const std::filesystem::path& file);

/// The same for an object of JSON: a member "sha256" of the text of the others.
Json sealed(Json object);
/// Nothing is missing and nothing differs from what was sealed.
bool is_sealed(const Json& object);

}  // namespace tabor::io
