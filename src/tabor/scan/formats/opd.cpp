// OPD, Wyko / Veeco interferometers: a directory of named blocks.
#include <fmt/format.h>

#include <cmath>
#include <map>

#include "tabor/scan/formats/bytes.hpp"
#include "tabor/scan/formats/readers.hpp"

namespace tabor::scan::format {
namespace {

constexpr std::string_view kMagic{"\x01\0Directory\0", 12};
constexpr std::size_t kEntrySize = 24;
constexpr double kMissingInteger = 32766;
constexpr double kMissingFloat = 1e38;

/// Kinds of blocks that hold one number.
enum class Kind : std::int16_t { i16 = 6, f32 = 7, f64 = 8, i32 = 12 };

struct Block {
  std::int16_t kind = 0;
  std::string_view bytes = {};
};

using Blocks = std::map<std::string, Block>;

/// Blocks lie in the order of the directory, the first entry of which is the directory itself.
Blocks take_blocks(const Contents& contents) {
  Cursor cursor(contents);
  cursor.skip(2);
  struct Entry {
    std::string name;
    std::int16_t kind;
    std::size_t length;
  };
  std::vector<Entry> entries;
  std::size_t n_entries = 1;
  for (std::size_t i = 0; i < n_entries; ++i) {
    const std::string name = cursor.take_text(16);
    const auto kind = cursor.take<std::int16_t>();
    const auto length = cursor.take<std::int32_t>();
    cursor.skip(2);  // flags
    if (length < 0) reject(contents, "a block of negative length", "a directory", kDamaged);
    if (i == 0) {
      n_entries = static_cast<std::size_t>(length) / kEntrySize;
    } else {
      entries.push_back({name, kind, static_cast<std::size_t>(length)});
    }
  }
  Blocks blocks;
  for (const auto& [name, kind, length] : entries) {
    const std::string_view bytes = cursor.take(length);
    if (!name.empty() && length > 0) blocks.emplace(name, Block{kind, bytes});
  }
  return blocks;
}

double scalar(const Contents& contents, const Blocks& blocks, const std::string& name) {
  const auto block = blocks.find(name);
  if (block == blocks.end()) reject(contents, "no '" + name + "'", "a Wyko height map", kDamaged);
  const Contents inside = contents.part(block->second.bytes);
  Cursor cursor(inside);
  switch (static_cast<Kind>(block->second.kind)) {
    case Kind::i16:
      return cursor.take<std::int16_t>();
    case Kind::i32:
      return cursor.take<std::int32_t>();
    case Kind::f32:
      return cursor.take<float>();
    case Kind::f64:
      return cursor.take<double>();
  }
  reject(contents, fmt::format("'{}' of kind {}", name, block->second.kind),
         "a number (6, 7, 8 or 12)", kDamaged);
}

/// Stored column after column from the left, each from the bottom up.
Field heights(const Contents& contents, std::string_view data, const Raster& columns) {
  const double missing = is_integer(columns.sample) ? kMissingInteger : kMissingFloat;
  const auto is_missing = [missing](double z) { return z >= missing || !std::isfinite(z); };
  return decode(contents, data, columns, holes_where(is_missing)).transpose().colwise().reverse();
}

/// Heights of an array block, but for what the other blocks say about them.
Layer layer_of(const Contents& block, Document& document) {
  Cursor cursor(block);
  const double nx = cursor.take<std::uint16_t>();
  const double ny = cursor.take<std::uint16_t>();
  const int size = cursor.take<std::uint16_t>();
  if (size != 1 && size != 2 && size != 4) {
    reject(block, fmt::format("samples of {} bytes", size), "1, 2 or 4", kDamaged);
  }
  const Sample sample = size == 1 ? Sample::u8 : size == 2 ? Sample::i16 : Sample::f32;
  check_size(block, nx, ny, cursor.left() / size_of(sample));
  const Raster columns{
      .sample = sample, .nx = static_cast<Index>(ny), .ny = static_cast<Index>(nx)};
  Layer layer{.unit = "nm", .nx = columns.ny, .ny = columns.nx};
  layer.load = [block, data = cursor.take(byte_size(columns)), columns] {
    return heights(block, data, columns);
  };
  warn_of_surplus(cursor, document);
  return layer;
}

}  // namespace

Match identify_opd(std::string_view head) {
  return head.starts_with(kMagic) ? Match::yes : Match::no;
}

Document open_opd(const Contents& contents) {
  const Blocks blocks = take_blocks(contents);
  const double pixel = scalar(contents, blocks, "Pixel_size") * 1e-3;
  const double aspect = blocks.contains("Aspect") ? scalar(contents, blocks, "Aspect") : 1;
  const double wavelength = scalar(contents, blocks, "Wavelength");
  const double multiplier = blocks.contains("Mult") ? scalar(contents, blocks, "Mult") : 1;
  if (!(wavelength > 0) || !(multiplier > 0)) {
    reject(contents, fmt::format("wavelength {} nm, Mult {}", wavelength, multiplier),
           "positive numbers", kDamaged);
  }
  Document document{.format = "opd", .instrument = "Wyko / Veeco"};
  for (const char* name : {"RAW_DATA", "RAW DATA", "OPD", "Raw", "SAMPLE_DATA"}) {
    const auto block = blocks.find(name);
    if (block == blocks.end()) continue;
    Layer layer = layer_of(contents.part(block->second.bytes), document);
    layer.name = name;
    layer.scale = wavelength / multiplier;
    layer.pixel_x = pixel;
    layer.pixel_y = pixel * aspect;
    layer.said_x = fmt::format("Pixel_size {:g} mm", pixel * 1e3);
    layer.said_y = fmt::format("{}, Aspect {:g}", layer.said_x, aspect);
    document.layers.push_back(std::move(layer));
  }
  if (document.layers.empty()) {
    reject(contents, "no height block (RAW_DATA)", "a Wyko height map", kDamaged);
  }
  if (document.layers.size() == 1) document.layers.front().name = "height";
  return document;
}

}  // namespace tabor::scan::format
