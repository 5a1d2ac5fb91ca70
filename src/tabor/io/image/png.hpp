#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tabor/core/types.hpp"

// Writes pictures and reads grey images as PNG.
namespace tabor::io {

/// Picture of 8 bits per value, rows from the top, `channels` values per pixel.
struct Picture {
  Index nx = 0;
  Index ny = 0;
  int channels = 1;  ///< 1 = grey, 3 = red green blue
  std::vector<std::uint8_t> values;
};

/// Writes a picture. Throws OutputError.
void write_png(const Picture& picture, const std::filesystem::path& file);

/// Grey picture of 16 bits per pixel with remarks, rows from the top.
struct GreyPicture {
  Index nx = 0;
  Index ny = 0;
  std::vector<std::uint16_t> counts = {};
  std::optional<std::uint16_t> transparent = {};    ///< the count of pixels without a value
  std::map<std::string, std::string> remarks = {};  ///< chunks tEXt, by their keywords
};

/// Writes a grey picture. Throws OutputError.
void write_png(const GreyPicture& picture, const std::filesystem::path& file);

/// Grey values of a PNG with 1 to 16 bits per sample, as counts (no scaling). read_png() rejects a
/// colour picture, as colours are no heights, and throws InputError.
struct GreyImage {
  Field counts;  ///< (ny, nx), NaN where the picture is transparent
  int bits = 8;  ///< per sample, as in the file
  std::map<std::string, std::string> remarks = {};  ///< as GreyPicture has them
};
GreyImage read_png(const std::filesystem::path& file);

}  // namespace tabor::io
