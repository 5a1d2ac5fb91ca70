#pragma once

#include <string>
#include <string_view>

namespace tabor::fuzz {

/// A chunk of a PNG file without its checksum, which repaired_png() puts right.
std::string png_chunk(std::string_view type, std::string_view data);

/// A grey PNG of 4 x 3 zero pixels as repaired_png() takes it: its pixels not yet packed.
std::string plain_png(int bits, int colour_type, int interlace);

/// The same file with the right checksum in every chunk, and with its pixels packed where they are
/// not: no mutation of packed bytes behind a checksum would get as far as their meaning. From the
/// first chunk that claims more than is left, everything stays as it is.
std::string repaired_png(std::string_view bytes);

}  // namespace tabor::fuzz
