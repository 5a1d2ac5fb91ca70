// OPD, Wyko / Veeco interferometers: a directory of named blocks.
#include <fmt/format.h>

#include <cmath>
#include <map>

#include "tabor/topography/formats/bytes.hpp"
#include "tabor/topography/formats/readers.hpp"

namespace tabor::topography::format {
namespace {

constexpr std::string_view kMagic{"\x01\0Directory\0", 12};
constexpr std::size_t kEntrySize = 24;
constexpr double kMissingInteger = 32766;
constexpr double kMissingFloat = 1e38;

using Blocks = std::map<std::string, std::string_view>;

/// Blocks lie in the order of the directory, the first entry of which is the directory itself.
Blocks take_blocks(const Contents& contents) {
  Cursor cursor(contents);
  cursor.skip(2);
  std::vector<std::pair<std::string, std::size_t>> entries;
  std::size_t n_entries = 1;
  for (std::size_t i = 0; i < n_entries; ++i) {
    const std::string name = cursor.take_text(16);
    cursor.skip(2);  // type
    const auto length = cursor.take<std::int32_t>();
    cursor.skip(2);  // flags
    if (length < 0) refuse(contents, "a block of negative length", "a directory", kDamaged);
    if (i == 0) {
      n_entries = static_cast<std::size_t>(length) / kEntrySize;
    } else if (!name.empty() && length > 0) {
      entries.emplace_back(name, static_cast<std::size_t>(length));
    }
  }
  Blocks blocks;
  for (const auto& [name, length] : entries) {
    blocks.emplace(name, cursor.take(length));
  }
  return blocks;
}

template <typename T>
double scalar(const Contents& contents, const Blocks& blocks, const std::string& name) {
  const auto block = blocks.find(name);
  if (block == blocks.end() || block->second.size() < sizeof(T)) {
    refuse(contents, "no '" + name + "'", "a Wyko height map", kDamaged);
  }
  T value;
  std::memcpy(&value, block->second.data(), sizeof(T));
  return static_cast<double>(value);
}

std::string_view height_block(const Contents& contents, const Blocks& blocks) {
  for (const char* name : {"RAW_DATA", "RAW DATA", "OPD", "Raw"}) {
    if (const auto block = blocks.find(name); block != blocks.end()) return block->second;
  }
  refuse(contents, "no height block (RAW_DATA)", "a Wyko height map", kDamaged);
}

/// Stored column after column from the left, each from the bottom up.
Field heights(const Contents& contents, std::string_view data, const Raster& columns) {
  const double missing = is_integer(columns.sample) ? kMissingInteger : kMissingFloat;
  const auto is_missing = [missing](double z) { return z >= missing || !std::isfinite(z); };
  return decode(contents, data, columns, holes_where(is_missing)).transpose().colwise().reverse();
}

}  // namespace

Match identify_opd(std::string_view head) {
  return head.starts_with(kMagic) ? Match::yes : Match::no;
}

Document open_opd(const Contents& contents) {
  const Blocks blocks = take_blocks(contents);
  const Contents block = contents.part(height_block(contents, blocks));
  Cursor cursor(block);
  const double nx = cursor.take<std::uint16_t>();
  const double ny = cursor.take<std::uint16_t>();
  const int size = cursor.take<std::uint16_t>();
  if (size != 1 && size != 2 && size != 4) {
    refuse(contents, fmt::format("samples of {} bytes", size), "1, 2 or 4", kDamaged);
  }
  const Sample sample = size == 1 ? Sample::u8 : size == 2 ? Sample::i16 : Sample::f32;
  check_size(contents, nx, ny, cursor.left() / size_of(sample));
  const Raster columns{
      .sample = sample, .nx = static_cast<Index>(ny), .ny = static_cast<Index>(nx)};
  const double pixel = scalar<float>(contents, blocks, "Pixel_size") * 1e-3;
  const double aspect = blocks.contains("Aspect") ? scalar<float>(contents, blocks, "Aspect") : 1;
  const double wavelength = scalar<float>(contents, blocks, "Wavelength");
  const double multiplier =
      blocks.contains("Mult") ? scalar<std::int16_t>(contents, blocks, "Mult") : 1;
  if (!(wavelength > 0) || !(multiplier > 0)) {
    refuse(contents, fmt::format("wavelength {} nm, Mult {}", wavelength, multiplier),
           "positive numbers", kDamaged);
  }
  Document document{.format = "opd", .instrument = "Wyko / Veeco"};
  document.layers.push_back({.name = "height",
                             .unit = "nm",
                             .scale = wavelength / multiplier,
                             .nx = columns.ny,
                             .ny = columns.nx,
                             .pixel_x = checked_pixel(contents, pixel),
                             .pixel_y = checked_pixel(contents, pixel * aspect),
                             .load = [contents, data = cursor.take(byte_size(columns)), columns] {
                               return heights(contents, data, columns);
                             }});
  return document;
}

}  // namespace tabor::topography::format
