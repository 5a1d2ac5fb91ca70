#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <string>

#include "support/folder.hpp"
#include "tabor/core/error.hpp"
#include "tabor/topography/file.hpp"

namespace tabor::test {

inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// A small map with holes in a corner and inside, irrational heights and pixels that are not
/// square.
inline topography::Topography small_map() {
  topography::Topography map;
  map.grid = {.nx = 5, .ny = 4, .lx = 5 * 0.67e-6, .ly = 4 * 1.1e-6};
  map.height = Field(4, 5);
  for (Index i = 0; i < 20; ++i) {
    map.height.data()[i] = 1e-6 * std::sin(1.0 + static_cast<double>(i * i));
  }
  map.height(0, 0) = kNaN;
  map.height(2, 3) = kNaN;
  map.channel = "surface";
  map.source = "made in a test";
  return map;
}

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

/// Builds the bytes of an instrument's file at given offsets.
class ByteFile {
 public:
  explicit ByteFile(std::size_t size = 0) : bytes_(size, '\0') {}

  ByteFile& text(std::size_t at, const std::string& text) {
    return raw(at, text.data(), text.size());
  }
  template <typename T>
  ByteFile& number(std::size_t at, T value) {
    return raw(at, &value, sizeof value);
  }
  template <typename T>
  ByteFile& big_endian(std::size_t at, T value) {
    char swapped[sizeof(T)];
    std::memcpy(swapped, &value, sizeof(T));
    std::reverse(swapped, swapped + sizeof(T));
    return raw(at, swapped, sizeof(T));
  }
  template <typename T>
  ByteFile& append(T value) {
    return number(bytes_.size(), value);
  }
  const std::string& bytes() const { return bytes_; }

 private:
  ByteFile& raw(std::size_t at, const void* data, std::size_t size) {
    if (bytes_.size() < at + size) bytes_.resize(at + size, '\0');
    std::memcpy(bytes_.data() + at, data, size);
    return *this;
  }
  std::string bytes_;
};

}  // namespace tabor::test
