#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "tabor/core/types.hpp"

// Reads the first image of a TIFF file as numbers, and writes maps as TIFF.
namespace tabor::io {

/// Description of the first image of a TIFF file, from its tags.
struct TiffDescription {
  Index nx = 0;
  Index ny = 0;
  int n_channels = 1;
  int bits = 1;  ///< per sample
  bool is_float = false;
  bool is_grey = false;        ///< false for colours and colour tables
  bool white_is_zero = false;  ///< bright pixels have the smaller samples
  bool is_compressed = false;
  bool is_tiled = false;
  bool starts_top_left = true;
  bool has_park_tags = false;  ///< Park Systems keeps heights in tags of its own
  int n_images = 1;
  std::string text = {};  ///< the tag ImageDescription
};

/// Reads the description. Throws InputError if the file is no TIFF or damaged.
TiffDescription describe_tiff(const std::filesystem::path& file);

/// Reads the samples of the first image as they are stored, shape (ny, nx); grey, in strips, of 8,
/// 16 or 32 bits or floats of 32 or 64. Throws InputError for every other and for damaged files.
/// NaN where the file says that a sample is missing (tag 42113 of GDAL). `progress` is told the
/// share of rows read so far.
Field read_tiff(const std::filesystem::path& file,
                const std::function<void(double share)>& progress = {});

/// Writes a map in single precision, grey, in strips, with `text` in the tag ImageDescription; NaN
/// is named as the missing sample. Throws OutputError.
void write_tiff(const Field& map, const std::string& text, const std::filesystem::path& file);

}  // namespace tabor::io
