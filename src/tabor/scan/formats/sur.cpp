// SUR, Digital Surf's surface files (Mountains and many instruments), plain and compressed. A file
// of several layers holds one object after the other, each with a header of its own (RosettaSciIO,
// digitalsurf).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tabor/core/text.hpp"
#include "tabor/core/units.hpp"
#include "tabor/io/files/deflate.hpp"
#include "tabor/scan/formats/bytes.hpp"
#include "tabor/scan/formats/readers.hpp"

namespace tabor::scan::format {
namespace {

constexpr std::string_view kPlain = "DIGITAL SURF";
constexpr std::string_view kCompressed = "DSCOMPRESSED";
constexpr int kProfile = 1;
constexpr int kSurface = 2;
/// Objects whose first layer holds heights: series of surfaces, layers of one surface, and surfaces
/// with intensity, colours, or both.
constexpr int kLayered[]{5, 8, 11, 13, 16};
constexpr std::size_t kMostLayers = 1000;

struct Header {
  int objects = 1;
  int type = 0;
  std::string name;
  bool marks_missing = false;
  int bits = 0;
  std::int32_t z_min = 0;
  double nx = 0;
  double ny = 0;
  double n_points = 0;
  bool is_inverted = false;
  double dx = 0, dy = 0, dz = 0;
  std::string dx_unit, dy_unit, dz_unit;
  double z_offset = 0;
  std::size_t n_skipped = 0;  ///< comment and private bytes between header and data
};

Header take_header(const Contents& contents) {
  Cursor cursor(contents);
  Header header;
  cursor.seek(14);
  header.objects = cursor.take<std::int16_t>();
  cursor.seek(18);
  header.type = cursor.take<std::int16_t>();
  header.name = cursor.take_text(30);
  cursor.seek(86);
  header.marks_missing = cursor.take<std::int16_t>() == 1;
  cursor.seek(98);
  header.bits = cursor.take<std::int16_t>();
  header.z_min = cursor.take<std::int32_t>();
  cursor.seek(108);
  header.nx = cursor.take<std::int32_t>();
  header.ny = cursor.take<std::int32_t>();
  header.n_points = cursor.take<std::int32_t>();
  cursor.seek(120);
  header.dx = cursor.take<float>();
  header.dy = cursor.take<float>();
  header.dz = cursor.take<float>();
  cursor.seek(132 + 3 * 16);
  header.dx_unit = cursor.take_text(16);
  header.dy_unit = cursor.take_text(16);
  header.dz_unit = cursor.take_text(16);
  cursor.seek(290);
  header.is_inverted = cursor.take<std::int16_t>() != 0;
  cursor.seek(334);
  header.n_skipped = cursor.take<std::uint16_t>();
  header.n_skipped += cursor.take<std::uint16_t>();
  cursor.seek(466 + 2 * 4);
  header.z_offset = cursor.take<float>();
  return header;
}

/// Pixels in what is no length are none: their size can be given.
std::optional<double> lateral(double pixel, const std::string& unit) {
  if (unit.empty()) return std::nullopt;
  return pixel * unit_factor(unit, dimension::length).value_or(kHole);
}

void require_surface(const Contents& contents, const Header& header) {
  // Gwyddion writes type 1 (profile) for surfaces.
  const bool is_surface =
      header.type == kSurface || (header.type == kProfile && header.ny >= 1) ||
      std::find(std::begin(kLayered), std::end(kLayered), header.type) != std::end(kLayered);
  if (!is_surface) {
    reject(contents, fmt::format("a Digital Surf object of type {}", header.type),
           "a surface (type 2), alone or with further layers", "export the height layer alone");
  }
}

void require_samples(const Contents& contents, const Header& header) {
  if (header.n_points != 0 && header.n_points != header.nx * header.ny) {
    reject(contents, fmt::format("{} points", header.n_points),
           fmt::format("{} x {}", header.nx, header.ny), kDamaged);
  }
  if (header.bits != 16 && header.bits != 32) {
    reject(contents, fmt::format("{} bits per point", header.bits), "16 or 32", kDamaged);
  }
  if (!std::isfinite(header.dz) || header.dz == 0 || !std::isfinite(header.z_offset)) {
    reject(contents, fmt::format("a height step of {}", header.dz), "a length", kDamaged);
  }
}

/// Compressed data: a count of streams, their raw and packed sizes, the zlib streams one after the
/// other.
std::string unpack(const Contents& contents, Cursor& cursor, std::size_t expected) {
  const auto n_streams = cursor.take<std::uint32_t>();
  if (n_streams == 0) reject(contents, "no compressed heights", "at least one stream", kDamaged);
  const std::size_t kEntry = 2 * sizeof(std::uint32_t);
  check_size(contents, 1, n_streams, cursor.left() / kEntry);
  std::vector<std::pair<std::size_t, std::size_t>> sizes;
  for (std::uint32_t i = 0; i < n_streams; ++i) {
    const std::size_t raw = cursor.take<std::uint32_t>();
    sizes.emplace_back(raw, cursor.take<std::uint32_t>());
  }
  std::string data;
  for (const auto& [raw, packed] : sizes) {
    const std::string_view stream = cursor.take(packed);
    if (raw > expected - data.size()) break;
    data += io::inflate(stream, raw, contents.file.string());
  }
  if (data.size() != expected) {
    reject(contents, fmt::format("{} bytes of unpacked heights", data.size()),
           fmt::format("{}", expected), kDamaged);
  }
  return data;
}

RowStep to_heights(const Header& header) {
  const double missing = header.marks_missing ? static_cast<double>(header.z_min) - 2 : kHole;
  return [missing, dz = header.dz, offset = header.z_offset](std::span<double> row) {
    for (double& z : row) z = z == missing ? kHole : z * dz + offset;
  };
}

/// The heights' bytes are only unpacked when they are asked for.
Field heights(const Contents& contents, std::size_t data_begin, const Raster& raster,
              const Header& header) {
  Cursor cursor(contents);
  cursor.seek(data_begin);
  if (!contents.bytes.starts_with(kCompressed)) {
    return decode(contents, cursor.take(byte_size(raster)), raster, to_heights(header));
  }
  const std::string unpacked = unpack(contents, cursor, byte_size(raster));
  return decode(contents, unpacked, raster, to_heights(header));
}

bool has_object(std::string_view bytes) {
  return bytes.starts_with(kPlain) || bytes.starts_with(kCompressed);
}

/// Bytes of the data of an object, at most up to the end of the file.
std::size_t data_size(const Contents& contents, std::size_t data_begin, const Raster& raster) {
  if (!contents.bytes.starts_with(kCompressed)) return byte_size(raster);
  Cursor cursor(contents);
  cursor.seek(data_begin);
  const auto n_streams = cursor.take<std::uint32_t>();
  std::size_t size = sizeof n_streams;
  for (std::uint32_t i = 0; i < n_streams; ++i) {
    cursor.skip(sizeof(std::uint32_t));  // unpacked
    size += 2 * sizeof(std::uint32_t) + cursor.take<std::uint32_t>();
    if (size > contents.bytes.size()) reject(contents, "streams beyond its end", "", kDamaged);
  }
  return size;
}

/// One object and the bytes it takes.
struct Object {
  Header header;
  Layer layer;
  std::size_t size = 0;
};

/// Reads the object that `contents` begins with.
Object take_object(const Contents& contents) {
  const Header header = take_header(contents);
  require_samples(contents, header);
  const bool is_compressed = contents.bytes.starts_with(kCompressed);
  Raster raster{.sample = header.bits == 16 ? Sample::i16 : Sample::i32};
  // A deflate stream unpacks to at most 1032 times its size.
  constexpr std::size_t kLargestRatio = 1032;
  if (is_compressed) {
    check_packed_size(contents, header.nx, header.ny, contents.bytes.size(), kLargestRatio,
                      size_of(raster.sample));
  } else {
    check_size(contents, header.nx, header.ny, contents.bytes.size() / size_of(raster.sample));
  }
  raster.nx = static_cast<Index>(header.nx);
  raster.ny = static_cast<Index>(header.ny);
  const std::size_t data_begin = 512 + header.n_skipped;
  const auto dx = lateral(header.dx, header.dx_unit);
  const bool is_profile = raster.ny == 1 && header.dy_unit.empty();
  Object object{.header = header,
                .layer = {.name = header.name.empty() ? "height" : header.name,
                          .unit = header.dz_unit,
                          .nx = raster.nx,
                          .ny = raster.ny,
                          .pixel_x = dx,
                          .pixel_y = is_profile ? dx : lateral(header.dy, header.dy_unit),
                          .said_x = fmt::format("a spacing of {:g} {}", header.dx, header.dx_unit),
                          .said_y = fmt::format("a spacing of {:g} {}", header.dy, header.dy_unit),
                          .load = [contents, data_begin, raster, header] {
                            return heights(contents, data_begin, raster, header);
                          }}};
  object.size = data_begin + data_size(contents, data_begin, raster);
  Cursor(contents).skip(object.size);  // all of it is there
  return object;
}

void warn_of_heights(const Header& header, Document& document) {
  warn_of_negative_scale(header.dz, document);
  if (header.is_inverted) {
    document.warnings.push_back(
        "The file says that its heights were inverted. Check that up is up");
  }
}

/// Layers behind the first one: intensity and colours have no unit of length.
void take_further_layers(const Contents& contents, std::size_t begin, Document& document) {
  std::string_view rest = contents.bytes.substr(begin);
  while (has_object(rest) && document.layers.size() < kMostLayers) {
    Object object = take_object(contents.part(rest));
    object.layer.is_picture = object.layer.unit.empty();
    if (object.header.name.empty()) {
      object.layer.name = fmt::format("layer {}", document.layers.size());
    }
    document.layers.push_back(std::move(object.layer));
    rest.remove_prefix(object.size);
  }
}

}  // namespace

Match identify_sur(std::string_view head) { return has_object(head) ? Match::yes : Match::no; }

Document open_sur(const Contents& contents) {
  require_surface(contents, take_header(contents));
  Object first = take_object(contents);
  Document document{.format = "sur"};
  warn_of_heights(first.header, document);
  document.layers.push_back(std::move(first.layer));
  take_further_layers(contents, first.size, document);
  const auto n_objects = static_cast<std::size_t>(std::max(first.header.objects, 1));
  if (document.layers.size() < n_objects) {
    document.warnings.push_back(
        fmt::format("only {} of {} layers are in the file", document.layers.size(), n_objects));
  }
  if (n_objects == 1 && document.layers.size() == 1 && contents.bytes.starts_with(kPlain)) {
    Cursor cursor(contents);
    cursor.skip(first.size);
    warn_of_surplus(cursor, document);
  }
  return document;
}

}  // namespace tabor::scan::format
