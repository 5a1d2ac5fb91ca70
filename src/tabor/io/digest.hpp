#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace tabor::io {

/// Digests as lower-case hexadecimal text.
std::string sha256(std::span<const std::byte> bytes);
std::string sha256(std::string_view text);
std::string sha256_of_file(const std::filesystem::path& file);  ///< throws InputError

/// Only because the X3P format asks for it.
std::string md5(std::span<const std::byte> bytes);

}  // namespace tabor::io
