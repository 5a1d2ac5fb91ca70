#pragma once

#include <filesystem>
#include <functional>

#include "tabor/core/types.hpp"

namespace tabor::io {

/// The first image of a TIFF file as its tags describe it.
struct TiffDescription {
  Index nx = 0;
  Index ny = 0;
  int n_channels = 1;
  int bits = 1;  ///< per sample
  bool is_float = false;
  bool is_grey = false;  ///< black is zero; false for colours, colour tables, white as zero
  bool is_compressed = false;
  bool is_tiled = false;
  bool starts_top_left = true;
  bool has_park_tags = false;  ///< Park Systems keeps heights in tags of its own
  int n_images = 1;
};

/// Throws InputError if the file is no TIFF or damaged.
TiffDescription describe_tiff(const std::filesystem::path& file);

/// The samples of the first image, shape (ny, nx); grey, in strips, of 8, 16 or 32 bits or floats
/// of 32 or 64: InputError for every other and for damaged files. NaN where the file says that a
/// sample is missing (tag 42113 of GDAL). `progress` is told the share of
/// rows read so far.
Field read_tiff(const std::filesystem::path& file,
                const std::function<void(double share)>& progress = {});

}  // namespace tabor::io
