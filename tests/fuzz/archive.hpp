#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "tabor/io/files/zip.hpp"

namespace tabor::fuzz {

/// How the `archive` target writes a ZIP archive as plain bytes: before each entry a line
/// "=== NAME", then the entry's bytes and a line feed.
std::string plain_archive(const std::vector<io::ZipContent>& entries);

/// The ZIP archive of such a listing; whatever stands before the first entry comes before the
/// archive, as in files that have a head of their own.
std::string packed_archive(std::string_view listing);

/// The listing of a ZIP archive.
std::string unpacked(const std::string& archive);

}  // namespace tabor::fuzz
