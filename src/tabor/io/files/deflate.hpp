#pragma once

#include <cstddef>
#include <string>
#include <string_view>

// Packs and unpacks zlib streams.
namespace tabor::io {

/// Returns the content of a zlib stream that unpacks to exactly `size` bytes; memory grows only
/// with bytes that were really unpacked. Throws InputError (`name` is the file) for anything else.
std::string inflate(std::string_view stream, std::size_t size, const std::string& name);

/// Returns a zlib stream of these bytes. Safe to call from any thread.
std::string deflate(std::string_view bytes);

}  // namespace tabor::io
