// Writing SUR, plain, of 32-bit heights in steps of a 2^30th of the largest height.
#include <algorithm>
#include <cmath>

#include "tabor/core/units.hpp"
#include "tabor/io/files/atomic_file.hpp"
#include "tabor/scan/formats/bytes.hpp"
#include "tabor/scan/formats/readers.hpp"

namespace tabor::scan::format {
namespace {

constexpr std::int32_t kLargest = std::int32_t{1} << 30;

void put_zeros(std::string& bytes, std::size_t n) { bytes.append(n, '\0'); }

/// Height of one count [m], which the file stores in single precision.
float step_of(const Field& height) {
  double largest = 0;
  for (Index i = 0; i < height.size(); ++i) {
    const double z = std::abs(height.data()[i]);
    if (z > largest) largest = z;  // false for holes
  }
  const auto step = static_cast<float>(largest / kLargest);
  return step > 0 ? step : 1e-15F;
}

struct Counts {
  std::vector<std::int32_t> values;
  std::int32_t least = 0;
  std::int32_t most = 0;
};

/// Heights in steps; a hole is two below the least.
Counts counts_of(const Field& height, double step) {
  Counts counts;
  counts.values.reserve(static_cast<std::size_t>(height.size()));
  counts.least = 2 * (kLargest - 1);
  counts.most = -counts.least;
  for (Index i = 0; i < height.size(); ++i) {
    const double z = height.data()[i];
    const auto count = std::isnan(z) ? 0 : static_cast<std::int32_t>(std::lround(z / step));
    counts.values.push_back(count);
    if (std::isnan(z)) continue;
    counts.least = std::min(counts.least, count);
    counts.most = std::max(counts.most, count);
  }
  for (Index i = 0; i < height.size(); ++i) {
    if (std::isnan(height.data()[i])) counts.values[static_cast<std::size_t>(i)] = counts.least - 2;
  }
  return counts;
}

/// Fields in the order of the file; their meaning is given by sur.cpp's reader.
std::string header_of(const topography::Topography& topography, const Counts& counts, float step) {
  constexpr std::int16_t kOneObject = 1, kVersion = 1, kSurface = 2, kBits = 32;
  const Grid& grid = topography.grid;
  const std::string name =
      writable_text(topography.channel.empty() ? "height" : topography.channel, 30);
  std::string bytes = "DIGITAL SURF";
  put(bytes, std::int16_t{0});  // byte order of PCs
  put(bytes, kOneObject);
  put(bytes, kVersion);
  put(bytes, kSurface);
  put_text(bytes, name, 30);
  put_text(bytes, "tabor", 30);
  put_zeros(bytes, 6);
  put(bytes, static_cast<std::int16_t>(topography::count_holes(topography) > 0));
  put_zeros(bytes, 10);
  put(bytes, kBits);
  put(bytes, counts.least);
  put(bytes, counts.most);
  for (const Index n : {grid.nx, grid.ny, grid.size()}) put(bytes, static_cast<std::int32_t>(n));
  put(bytes, static_cast<float>(grid.dx()));
  put(bytes, static_cast<float>(grid.dy()));
  put(bytes, step);
  for (const char* axis : {"X", "Y", "Z"}) put_text(bytes, axis, 16);
  for (int i = 0; i < 6; ++i) put_text(bytes, "m", 16);  // of steps and of lengths
  for (int i = 0; i < 3; ++i) put(bytes, 1.0F);          // ratios between both
  bytes.resize(512, '\0');
  return bytes;
}

}  // namespace

void write_sur(const topography::Topography& topography, const std::filesystem::path& file) {
  constexpr Index kMostPixels = 0x7FFFFFFF;
  if (topography.grid.size() > kMostPixels) {
    throw InputError(file.string(), "more than 2147483647 pixels", "fewer in a .sur file",
                     "write .h5, or use <resample>");
  }
  const float step = step_of(topography.height);
  const Counts counts = counts_of(topography.height, step);
  std::string bytes = header_of(topography, counts, step);
  for (const std::int32_t count : counts.values) put(bytes, count);
  io::write_file(file, std::string_view(bytes));
}

std::string note_sur(const topography::Topography& topography) {
  return "heights in steps of " + format_si(static_cast<double>(step_of(topography.height)), "m") +
         ", pixels in single precision";
}

}  // namespace tabor::scan::format
