#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "support/byte_file.hpp"
#include "support/folder.hpp"
#include "support/sample_map.hpp"
#include "tabor/core/error.hpp"
#include "tabor/topography/file.hpp"

namespace tabor::test {

/// Same bits at every pixel, holes at the same places.
inline ::testing::AssertionResult same_bits(const Field& a, const Field& b) {
  if (a.rows() != b.rows() || a.cols() != b.cols()) {
    return ::testing::AssertionFailure()
           << a.rows() << "x" << a.cols() << " against " << b.rows() << "x" << b.cols();
  }
  for (Index i = 0; i < a.size(); ++i) {
    const double x = a.data()[i];
    const double y = b.data()[i];
    if (std::isnan(x) != std::isnan(y) || (!std::isnan(x) && x != y)) {
      return ::testing::AssertionFailure() << "pixel " << i << ": " << x << " against " << y;
    }
  }
  return ::testing::AssertionSuccess();
}

/// What the InputError of reading this file says; "" if it was read.
inline std::string refusal(const std::filesystem::path& file,
                           const topography::ReadOptions& options = {}) {
  try {
    topography::read(file, options);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

inline std::string refusal(const Folder& folder, const std::string& bytes,
                           const topography::ReadOptions& options = {}) {
  put_bytes(folder / "scan.bin", bytes);
  return refusal(folder / "scan.bin", options);
}

inline topography::Topography read_bytes(const Folder& folder, const std::string& bytes,
                                         const topography::ReadOptions& options = {}) {
  put_bytes(folder / "scan.bin", bytes);
  return topography::read(folder / "scan.bin", options);
}

/// The options that complete files without unit and pixel.
inline topography::ReadOptions micrometres() {
  topography::ReadOptions options;
  options.pixel_x = 1e-6;
  options.unit = "um";
  return options;
}

}  // namespace tabor::test
