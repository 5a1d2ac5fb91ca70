// GSF, Gwyddion Simple Field: a text header and float32 heights.
#include <fmt/format.h>

#include <cmath>
#include <map>

#include "tabor/core/text.hpp"
#include "tabor/core/units.hpp"
#include "tabor/io/files/atomic_file.hpp"
#include "tabor/scan/formats/bytes.hpp"
#include "tabor/scan/formats/readers.hpp"

namespace tabor::scan::format {
namespace {

constexpr std::string_view kMagic = "Gwyddion Simple Field 1.0\n";
constexpr std::size_t kAlignment = 4;

using Header = std::map<std::string, std::string>;

Header parse_header(const Contents& contents, std::string_view text) {
  Header header;
  for (const std::string& line : split(text, '\n')) {
    if (trim(line).empty()) continue;
    const std::size_t equals = line.find('=');
    if (equals == std::string::npos) {
      reject(contents, "header line '" + line.substr(0, 40) + "'", "Key = value", kDamaged);
    }
    header[std::string(trim(line.substr(0, equals)))] =
        trim(std::string_view(line).substr(equals + 1));
  }
  return header;
}

std::string value_of(const Header& header, const std::string& key) {
  const auto item = header.find(key);
  return item == header.end() ? "" : item->second;
}

double count(const Contents& contents, const Header& header, const std::string& key) {
  const auto value = parse_number(value_of(header, key));
  if (!value) reject(contents, "no number " + key, "the size of the map", kDamaged);
  return *value;
}

/// Without units XReal is only a number (its default is 1).
std::optional<double> pixel(const Header& header, const std::string& key, Index n) {
  const auto factor = unit_factor(value_of(header, "XYUnits"), dimension::length);
  const std::string text = value_of(header, key);
  if (!factor || text.empty()) return std::nullopt;
  return parse_number(text).value_or(kHole) * *factor / static_cast<double>(n);
}

std::string said(const Header& header, const std::string& key) {
  return key + " = " + value_of(header, key);
}

}  // namespace

Match identify_gsf(std::string_view head) {
  return head.starts_with(kMagic) ? Match::yes : Match::no;
}

Document open_gsf(const Contents& contents) {
  const std::size_t end = contents.bytes.find('\0');
  if (end == std::string_view::npos) reject(contents, "no end of its header", "", kDamaged);
  const Header header =
      parse_header(contents, contents.bytes.substr(kMagic.size(), end - kMagic.size()));
  Cursor cursor(contents);
  cursor.skip((end / kAlignment + 1) * kAlignment);
  const double nx = count(contents, header, "XRes");
  const double ny = count(contents, header, "YRes");
  check_size(contents, nx, ny, cursor.left() / sizeof(float));
  Layer layer{.name = value_of(header, "Title"), .unit = value_of(header, "ZUnits")};
  if (layer.name.empty()) layer.name = "height";
  layer.nx = static_cast<Index>(nx);
  layer.ny = static_cast<Index>(ny);
  layer.pixel_x = pixel(header, "XReal", layer.nx);
  layer.pixel_y = pixel(header, "YReal", layer.ny);
  layer.said_x = said(header, "XReal");
  layer.said_y = said(header, "YReal");
  const Raster raster{.sample = Sample::f32, .nx = layer.nx, .ny = layer.ny};
  layer.load = [contents, data = cursor.take(byte_size(raster)), raster] {
    return decode(contents, data, raster);
  };
  Document document{.format = "gsf"};
  warn_of_surplus(cursor, document);
  document.metadata = header;
  document.layers.push_back(std::move(layer));
  return document;
}

void write_gsf(const topography::Topography& topography, const std::filesystem::path& file) {
  const Grid& grid = topography.grid;
  const std::string title =
      writable_text(topography.channel.empty() ? "height" : topography.channel);
  std::string bytes(kMagic);
  bytes += fmt::format("XRes = {}\nYRes = {}\nXReal = {:.17g}\nYReal = {:.17g}\n", grid.nx, grid.ny,
                       grid.lx, grid.ly);
  bytes += fmt::format("XYUnits = m\nZUnits = m\nTitle = {}\n", title);
  bytes.resize((bytes.size() / kAlignment + 1) * kAlignment, '\0');
  put_field_f32(bytes, topography.height);
  io::write_file(file, std::string_view(bytes));
}

}  // namespace tabor::scan::format
