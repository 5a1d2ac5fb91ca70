// SDF, the surface data file of ISO 25178-71 (BCR-STM of the 1990s), ascii and binary.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

#include "tabor/core/text.hpp"
#include "tabor/io/files/atomic_file.hpp"
#include "tabor/scan/formats/bytes.hpp"
#include "tabor/scan/formats/readers.hpp"
#include "tabor/scan/formats/text_numbers.hpp"

namespace tabor::scan::format {
namespace {

constexpr double kMaxPoints = 65535;  // the header counts points in 16 bits

struct Header {
  std::string maker;
  std::string created;
  double nx = 0;
  double ny = 0;
  double x_scale = 0;  ///< [m] per pixel
  double y_scale = 0;
  double z_scale = 0;  ///< [m] per count
  int compression = 0;
  int data_type = 0;
};

Sample sample_of(const Contents& contents, int data_type) {
  static constexpr Sample kinds[]{Sample::u8, Sample::u16, Sample::u32, Sample::f32,
                                  Sample::i8, Sample::i16, Sample::i32, Sample::f64};
  if (data_type < 0 || data_type > 7) {
    reject(contents, fmt::format("data type {}", data_type), "0 to 7", kDamaged);
  }
  return kinds[data_type];
}

/// The value that means "not measured": the least signed integer; floats use NaN.
double missing_value(Sample sample) {
  switch (sample) {
    case Sample::i8:
      return -128.0;
    case Sample::i16:
      return -32768.0;
    case Sample::i32:
      return -2147483648.0;
    default:
      return kHole;
  }
}

Layer layer_of(const Contents& contents, const Header& header) {
  if (header.compression != 0) {
    reject(contents, "compressed data", "none, as ISO 25178-71 defines no compression");
  }
  if (!std::isfinite(header.z_scale) || header.z_scale == 0) {
    reject(contents, fmt::format("a Zscale of {}", header.z_scale), "a length", kDamaged);
  }
  // Profiles of NPL's softgauges have no second spacing.
  const bool is_profile = header.ny == 1 && header.y_scale == 0;
  return {.name = "height",
          .unit = "m",
          .scale = header.z_scale,
          .nx = static_cast<Index>(header.nx),
          .ny = static_cast<Index>(header.ny),
          .pixel_x = header.x_scale,
          .pixel_y = is_profile ? header.x_scale : header.y_scale,
          .said_x = fmt::format("Xscale {:g}", header.x_scale),
          .said_y = fmt::format("Yscale {:g}", header.y_scale)};
}

Document document_of(std::string name, const Header& header, Layer layer) {
  Document document{.format = std::move(name), .instrument = header.maker};
  if (!header.created.empty()) document.metadata["CreateDate"] = header.created;
  document.layers.push_back(std::move(layer));
  return document;
}

/// The third section of a file is text.
bool is_trailer(std::string_view bytes) {
  return std::all_of(bytes.begin(), bytes.end(), [](char c) {
    return (c >= ' ' && c <= '~') || c == '\t' || c == '\r' || c == '\n';
  });
}

Header take_binary_header(Cursor& cursor) {
  Header header;
  cursor.skip(8);
  header.maker = cursor.take_text(10);
  header.created = cursor.take_text(12);
  cursor.skip(12);  // modified
  header.nx = cursor.take<std::uint16_t>();
  header.ny = cursor.take<std::uint16_t>();
  header.x_scale = cursor.take<double>();
  header.y_scale = cursor.take<double>();
  header.z_scale = cursor.take<double>();
  cursor.take<double>();  // resolution
  header.compression = cursor.take<std::uint8_t>();
  header.data_type = cursor.take<std::uint8_t>();
  cursor.skip(1);  // check type
  return header;
}

bool is_version(std::string_view head, char kind) {
  if (head.size() < 9 || head[0] != kind || head[4] != '-') return false;
  const std::string_view number = head.substr(head[5] == 'V' ? 6 : 5, 2);  // "aNPL-V1.0"
  return number[0] >= '0' && number[0] <= '9' && number[1] == '.';
}

/// "Key = value" lines up to the line with the star, which are removed from `text`.
std::map<std::string, std::string> take_keys(const Contents& contents, std::string_view& text,
                                             std::size_t& n_lines) {
  std::map<std::string, std::string> keys;
  const char line_end = line_end_of(text);
  take_line(text, line_end);  // version
  for (n_lines = 1; !text.empty();) {
    const std::string_view line = trim(take_line(text, line_end));
    ++n_lines;
    if (line.starts_with('*')) return keys;
    const std::size_t equals = line.find('=');
    if (equals == std::string_view::npos) continue;
    keys[lower(trim(line.substr(0, equals)))] = trim(line.substr(equals + 1));
  }
  reject(contents, "no '*' after its header", "an SDF header", kDamaged);
}

Header header_of(const Contents& contents, std::map<std::string, std::string> keys) {
  const auto number = [&](const char* key) {
    const auto value = parse_number(keys[key]);
    if (!value) reject(contents, fmt::format("no number '{}'", key), "an SDF header", kDamaged);
    return *value;
  };
  Header header{.maker = keys["manufacid"], .created = keys["createdate"]};
  header.nx = number("numpoints");
  header.ny = number("numprofiles");
  header.x_scale = number("xscale");
  header.y_scale = number("yscale");
  header.z_scale = number("zscale");
  header.compression = parse_number(keys["compression"]).value_or(0) == 0 ? 0 : 1;
  return header;
}

}  // namespace

Match identify_sdf(std::string_view head) { return is_version(head, 'b') ? Match::yes : Match::no; }

Document open_sdf(const Contents& contents) {
  Cursor cursor(contents);
  const Header header = take_binary_header(cursor);
  Raster raster{.sample = sample_of(contents, header.data_type)};
  check_size(contents, header.nx, header.ny, cursor.left() / size_of(raster.sample));
  Layer layer = layer_of(contents, header);
  raster.nx = layer.nx;
  raster.ny = layer.ny;
  const std::string_view data = cursor.take(byte_size(raster));
  layer.load = [contents, data, raster, missing = missing_value(raster.sample)] {
    return decode(contents, data, raster,
                  holes_where([missing](double z) { return z == missing; }));
  };
  Document document = document_of("sdf", header, std::move(layer));
  if (!is_trailer(contents.bytes.substr(cursor.position()))) warn_of_surplus(cursor, document);
  warn_of_negative_scale(header.z_scale, document);
  return document;
}

Match identify_sdf_ascii(std::string_view head) {
  return is_version(head, 'a') ? Match::yes : Match::no;
}

Document open_sdf_ascii(const Contents& contents) {
  std::string_view text = contents.bytes;
  std::size_t n_lines = 0;
  const Header header = header_of(contents, take_keys(contents, text, n_lines));
  const std::size_t end = text.find('*');
  if (end == std::string_view::npos) reject(contents, "no '*' after its data", "", kDamaged);
  TextNumbers numbers = parse_numbers(contents, text.substr(0, end), {.first_line = n_lines + 1});
  check_size(contents, header.nx, header.ny, numbers.values.size());
  if (static_cast<double>(numbers.values.size()) != header.nx * header.ny) {
    reject(contents, fmt::format("{} heights", numbers.values.size()),
           fmt::format("{} x {} as its header says", header.nx, header.ny), kDamaged);
  }
  Layer layer = layer_of(contents, header);
  const auto values = std::make_shared<const std::vector<double>>(std::move(numbers.values));
  layer.load = [values, nx = layer.nx, ny = layer.ny]() -> Field {
    return Eigen::Map<const Field>(values->data(), ny, nx);
  };
  return document_of("sdf-ascii", header, std::move(layer));
}

namespace {

void require_countable(const topography::Topography& topography,
                       const std::filesystem::path& file) {
  const Grid& grid = topography.grid;
  if (static_cast<double>(std::max(grid.nx, grid.ny)) <= kMaxPoints) return;
  throw InputError(file.string(), fmt::format("{} x {} pixels", grid.nx, grid.ny),
                   "at most 65535 along a side in SDF", "write .x3p or .h5 instead");
}

/// ddMMyyyyHHmm; a fixed date keeps the output a function of the input alone.
constexpr std::string_view kDate = "010119700000";

constexpr std::size_t kMakerSize = 10;

std::string maker_of(const topography::Topography& topography) {
  return writable_text(topography.instrument, kMakerSize);
}

}  // namespace

void write_sdf(const topography::Topography& topography, const std::filesystem::path& file) {
  require_countable(topography, file);
  const Grid& grid = topography.grid;
  std::string bytes;
  put_text(bytes, "bISO-1.0", 8);
  put_text(bytes, maker_of(topography), kMakerSize);
  put_text(bytes, kDate, 12);
  put_text(bytes, kDate, 12);
  put(bytes, static_cast<std::uint16_t>(grid.nx));
  put(bytes, static_cast<std::uint16_t>(grid.ny));
  put(bytes, grid.dx());
  put(bytes, grid.dy());
  put(bytes, 1.0);   // heights are in metres
  put(bytes, -1.0);  // resolution unknown
  put<std::uint8_t>(bytes, 0);
  put<std::uint8_t>(bytes, 7);  // float64
  put<std::uint8_t>(bytes, 0);
  put_field(bytes, topography.height);
  io::write_file(file, std::string_view(bytes));
}

void write_sdf_ascii(const topography::Topography& topography, const std::filesystem::path& file) {
  require_countable(topography, file);
  const Grid& grid = topography.grid;
  std::string text = fmt::format(
      "aISO-1.0\nManufacID = {}\nCreateDate = {}\nModDate = {}\nNumPoints = {}\nNumProfiles = {}\n"
      "Xscale = {}\nYscale = {}\nZscale = 1\nZresolution = -1\nCompression = 0\nDataType = 7\n"
      "CheckType = 0\n*\n",
      maker_of(topography), kDate, kDate, grid.nx, grid.ny, grid.dx(), grid.dy());
  for (Index y = 0; y < grid.ny; ++y) {
    for (Index x = 0; x < grid.nx; ++x) {
      const double z = topography.height(y, x);
      text += std::isnan(z) ? std::string("BAD") : fmt::format("{}", z);
      text += x + 1 < grid.nx ? ' ' : '\n';
    }
  }
  io::write_file(file, std::string_view(text + "*\n*\n"));
}

}  // namespace tabor::scan::format
