// VK3, VK4, VK6, VK7: Keyence laser scanning microscopes. The newer two wrap a VK4 into a ZIP
// archive.
#include <fmt/format.h>

#include <array>
#include <memory>

#include "tabor/scan/formats/archive.hpp"
#include "tabor/scan/formats/bytes.hpp"
#include "tabor/scan/formats/readers.hpp"

namespace tabor::scan::format {
namespace {

constexpr std::string_view kZipMagic = "PK\x03\x04";
constexpr const char* kMember = "Vk4File";
constexpr std::size_t kOffsetsAt = 12;
constexpr std::size_t kFirstLight = 3;   // of three intensity images in the table of offsets
constexpr std::size_t kFirstHeight = 6;  // of three height maps
constexpr std::size_t kFirstOfNeither = 9;
constexpr std::size_t kPaletteSize = 768;
constexpr double kPicometre = 1e-12;

bool is_stream(std::string_view bytes) {
  return bytes.starts_with("VK4_") || bytes.starts_with("VK3_");
}

std::uint32_t number_at(const Contents& contents, std::size_t position) {
  Cursor cursor(contents);
  cursor.seek(position);
  return cursor.take<std::uint32_t>();
}

/// Pixel and height of a count, numbers 42 to 44 of the measuring conditions.
struct Scales {
  double pixel_x;  ///< [m]
  double pixel_y;
  double z;  ///< [m] per count
};

Scales scales_of(const Contents& contents) {
  const std::size_t conditions = number_at(contents, kOffsetsAt);
  const auto picometres = [&](std::size_t index) {
    return kPicometre * number_at(contents, conditions + index * sizeof(std::uint32_t));
  };
  const double z = picometres(44);
  if (!(z > 0)) reject(contents, "a height step of 0", "a height per count", kDamaged);
  return {picometres(42), picometres(43), z};
}

Sample sample_of(const Contents& contents, std::uint32_t bits) {
  switch (bits) {
    case 8:
      return Sample::u8;
    case 16:
      return Sample::u16;
    case 32:
      return Sample::u32;
    default:
      reject(contents, fmt::format("{} bits per sample", bits), "8, 16 or 32", kDamaged);
  }
}

Layer layer_at(const Contents& contents, std::size_t position, const Scales& scales) {
  Cursor cursor(contents);
  cursor.seek(position);
  const double nx = cursor.take<std::uint32_t>();
  const double ny = cursor.take<std::uint32_t>();
  Raster raster{.sample = sample_of(contents, cursor.take<std::uint32_t>())};
  if (cursor.take<std::uint32_t>() != 0) {
    reject(contents, "compressed samples", "plain ones", "save it uncompressed");
  }
  const double n_bytes = cursor.take<std::uint32_t>();
  cursor.skip(2 * sizeof(std::uint32_t) + kPaletteSize);  // range, colours
  check_size(contents, nx, ny, cursor.left() / size_of(raster.sample));
  if (n_bytes != 0 && n_bytes != nx * ny * static_cast<double>(size_of(raster.sample))) {
    reject(contents, fmt::format("{} bytes of samples", n_bytes),
           fmt::format("those of {} x {} pixels", nx, ny), kDamaged);
  }
  raster.nx = static_cast<Index>(nx);
  raster.ny = static_cast<Index>(ny);
  Layer layer{.nx = raster.nx, .ny = raster.ny, .pixel_x = scales.pixel_x};
  layer.pixel_y = scales.pixel_y;
  layer.said_x = "the measuring conditions";
  layer.said_y = layer.said_x;
  layer.load = [contents, data = cursor.take(byte_size(raster)), raster] {
    return decode(contents, data, raster);
  };
  return layer;
}

Document open_stream(const Contents& contents) {
  const Scales scales = scales_of(contents);
  Document document{.format = "vk", .instrument = "Keyence"};
  for (std::size_t i = kFirstLight; i < kFirstOfNeither; ++i) {
    const std::size_t position = number_at(contents, kOffsetsAt + i * sizeof(std::uint32_t));
    if (position == 0) continue;
    const bool is_picture = i < kFirstHeight;
    Layer layer;
    try {
      layer = layer_at(contents, position, scales);
    } catch (const InputError&) {
      if (is_picture) continue;  // heights do not need it
      throw;
    }
    layer.is_picture = is_picture;
    layer.name = layer.is_picture ? fmt::format("light {}", i - kFirstLight + 1)
                                  : fmt::format("height {}", i - kFirstHeight + 1);
    if (!layer.is_picture) {
      layer.unit = "m";
      layer.scale = scales.z;
    }
    document.layers.push_back(std::move(layer));
  }
  return document;
}

/// What precedes the archive is Keyence's own; a picture in it may hold the archive's signature by
/// chance, so the first place is taken from which an archive with the member can be read.
std::string unwrapped(const Contents& contents) {
  constexpr int kMaxTries = 16;
  std::size_t at = contents.bytes.find(kZipMagic);
  for (int i = 0; i < kMaxTries && at != std::string_view::npos; ++i) {
    try {
      const Archive archive(contents.part(contents.bytes.substr(at)), kMember, "VK6 or VK7");
      return archive.read(archive.main_entry());
    } catch (const Unrecognised&) {
      break;
    } catch (const InputError&) {
      at = contents.bytes.find(kZipMagic, at + 1);
    }
  }
  reject(contents, "no Vk4File in its archive", "a VK6 or VK7 file", kDamaged);
}

}  // namespace

Match identify_vk(std::string_view head) {
  const bool known = is_stream(head) || head.starts_with("VK6") || head.starts_with("VK7");
  return known ? Match::yes : Match::no;
}

Document open_vk(const Contents& contents) {
  if (is_stream(contents.bytes)) return open_stream(contents);
  const auto stream = std::make_shared<const std::string>(unwrapped(contents));
  if (!is_stream(*stream)) reject(contents, "a Vk4File of another kind", "VK4", kDamaged);
  Document document = open_stream(contents.part(*stream));
  for (Layer& layer : document.layers) {
    layer.load = [load = layer.load, stream] { return load(); };  // the bytes live as long
  }
  return document;
}

}  // namespace tabor::scan::format
