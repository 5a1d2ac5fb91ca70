#pragma once

#include <gmock/gmock.h>

#include <cmath>
#include <string>

#include "support/byte_file.hpp"
#include "support/folder.hpp"
#include "support/sample_map.hpp"
#include "tabor/core/error.hpp"
#include "tabor/scan/file.hpp"

namespace tabor::test {

/// What the main.xml of an X3P file says, as text, so that it can lie.
struct X3pText {
  std::string nx = "2";
  std::string ny = "2";
  std::string increment = "1e-6";
  std::string link = "data.bin";
};

/// A surface of float64 heights; no checksum.
inline std::string x3p_xml(const X3pText& text) {
  const std::string axis =
      "<AxisType>I</AxisType><DataType>D</DataType><Increment>" + text.increment + "</Increment>";
  return "<p:ISO5436_2 xmlns:p=\"x\"><Record1><FeatureType>SUR</FeatureType><Axes><CX>" + axis +
         "</CX><CY>" + axis + "</CY><CZ><AxisType>A</AxisType><DataType>D</DataType></CZ></Axes>" +
         "</Record1><Record3><MatrixDimension><SizeX>" + text.nx + "</SizeX><SizeY>" + text.ny +
         "</SizeY><SizeZ>1</SizeZ></MatrixDimension><DataLink><PointDataLink>" + text.link +
         "</PointDataLink></DataLink></Record3></p:ISO5436_2>";
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
inline std::string rejection(const std::filesystem::path& file,
                             const scan::ReadOptions& options = {}) {
  try {
    scan::read(file, options);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

inline std::string rejection(const Folder& folder, const std::string& bytes,
                             const scan::ReadOptions& options = {}) {
  put_bytes(folder / "scan.bin", bytes);
  return rejection(folder / "scan.bin", options);
}

inline topography::Topography read_bytes(const Folder& folder, const std::string& bytes,
                                         const scan::ReadOptions& options = {}) {
  put_bytes(folder / "scan.bin", bytes);
  return scan::read(folder / "scan.bin", options);
}

/// The options that complete files without unit and pixel.
inline scan::ReadOptions micrometres() {
  scan::ReadOptions options;
  options.pixel_x = 1e-6;
  options.unit = "um";
  return options;
}

}  // namespace tabor::test
