// Seconds to read a scan of every writable kind, beside the least that reading it can be: the bytes
// through one system call after another and the plainest conversion to numbers.
//
// usage: bench_reading FOLDER SIDE    writes FOLDER/scan.* of SIDE x SIDE pixels, then reads them
#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include "tabor/core/parallel.hpp"
#include "tabor/core/resources.hpp"
#include "tabor/io/files/zip.hpp"
#include "tabor/io/hdf5/hdf5.hpp"
#include "tabor/scan/file.hpp"
#include "tabor/topography/warnings.hpp"

namespace {

namespace fs = std::filesystem;
using tabor::Field;
using tabor::Index;

/// Waves and noise: text of full length, data that pack as badly as measured ones.
tabor::topography::Topography surface(Index side) {
  tabor::topography::Topography map;
  map.grid = {.nx = side, .ny = side, .lx = 1e-6 * static_cast<double>(side), .ly = 0};
  map.grid.ly = map.grid.lx;
  map.height.resize(side, side);
  std::uint64_t state = 1;
  for (Index i = 0; i < map.height.size(); ++i) {
    state = state * 6364136223846793005u + 1442695040888963407u;  // Knuth's MMIX generator
    const double noise = static_cast<double>(state >> 40) * 0x1p-24;
    map.height.data()[i] = 1e-7 * noise + 1e-6 * std::sin(1e-2 * static_cast<double>(i % side));
  }
  return map;
}

std::string bytes_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::string bytes(fs::file_size(file), '\0');
  stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  return bytes;
}

template <typename Sample>
double from_samples(const std::string& bytes, std::size_t offset, Index side) {
  Field field(side, side);
  for (Index i = 0; i < field.size(); ++i) {
    Sample sample;
    std::memcpy(&sample, bytes.data() + offset + static_cast<std::size_t>(i) * sizeof sample,
                sizeof sample);
    field.data()[i] = static_cast<double>(sample);
  }
  return field(side - 1, side - 1);
}

double from_text(const std::string& bytes, Index side) {
  Field field(side, side);
  const char* at = bytes.data();
  const char* end = at + bytes.size();
  for (int line = 0; line < 4; ++line) at = std::find(at, end, '\n') + 1;  // the header
  for (Index i = 0; i < field.size(); ++i) at = std::from_chars(at, end, field.data()[i]).ptr + 1;
  return field(side - 1, side - 1);
}

double from_archive(const fs::path& file, Index side) {
  const std::string bytes = bytes_of(file);
  const tabor::io::ZipReader zip(bytes, file.string());
  for (const tabor::io::ZipEntry& entry : zip.entries()) {
    if (entry.name.ends_with("data.bin")) {
      return from_samples<double>(zip.read(entry, entry.size), 0, side);
    }
  }
  return 0;
}

struct Kind {
  const char* extension;
  std::function<double(const fs::path& file, Index side)> least;  ///< the last height
};

std::vector<Kind> kinds() {
  constexpr std::size_t kSdfHeader = 81;
  return {
      {".sdf", [](const fs::path& file,
                  Index side) { return from_samples<double>(bytes_of(file), kSdfHeader, side); }},
      {".npy",
       [](const fs::path& file, Index side) {
         const std::string bytes = bytes_of(file);
         return from_samples<double>(
             bytes, bytes.size() - 8 * static_cast<std::size_t>(side * side), side);
       }},
      {".gsf",
       [](const fs::path& file, Index side) {
         const std::string bytes = bytes_of(file);
         return from_samples<float>(bytes, bytes.size() - 4 * static_cast<std::size_t>(side * side),
                                    side);
       }},
      {".h5",
       [](const fs::path& file, Index side) {
         return tabor::io::Hdf5Reader(file).field("/surface/height")(side - 1, side - 1);
       }},
      {".x3p", from_archive},
      {".txt", [](const fs::path& file, Index side) { return from_text(bytes_of(file), side); }}};
}

void measure(const Kind& kind, const fs::path& folder, Index side) {
  constexpr int kRepeats = 3;
  const fs::path file = folder / (std::string("scan") + kind.extension);
  tabor::scan::ReadOptions options;
  if (std::string(kind.extension) == ".npy") {
    options.pixel_x = 1e-6;
    options.unit = "m";
  }
  double read = 0;
  double least = INFINITY;
  double warnings = INFINITY;
  for (int i = 0; i < kRepeats; ++i) {
    const tabor::Stopwatch reading;
    const auto map = tabor::scan::read(file, options);
    const double with_warnings = reading.seconds();
    const tabor::Stopwatch watch;
    tabor::topography::warnings(map);
    // Both of the same repeat: the difference of two best ones could be anything.
    const double its_warnings = watch.seconds();
    read = i == 0 ? with_warnings - its_warnings : std::max(read, with_warnings - its_warnings);
    warnings = std::min(warnings, its_warnings);
    const tabor::Stopwatch plain;
    if (kind.least(file, side) != map.height(side - 1, side - 1)) fmt::print("differs\n");
    least = std::min(least, plain.seconds());
  }
  fmt::print("{} {:.3g} {:.3g} {:.3g}\n", kind.extension, read, warnings, least);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const fs::path folder = argv[1];
  const Index side = std::stol(argv[2]);
  {
    const auto map = surface(side);
    for (const Kind& kind : kinds()) {
      tabor::scan::write(map, folder / (std::string("scan") + kind.extension));
    }
  }
  for (const Kind& kind : kinds()) measure(kind, folder, side);
}
