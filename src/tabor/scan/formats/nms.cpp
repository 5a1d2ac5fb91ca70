// NMS, NanoFocus usurf confocal microscopes.
#include <fmt/format.h>

#include <cmath>

#include "tabor/scan/formats/bytes.hpp"
#include "tabor/scan/formats/readers.hpp"

namespace tabor::scan::format {
namespace {

constexpr std::size_t kSizeAt = 1368;
constexpr std::size_t kHeightsAt = 3468;
constexpr double kFullScale = 65535;  // raw 0 and 65535 are the lowest and the highest point
constexpr std::string_view kVersion = "OM_MS_";

}  // namespace

Match identify_nms(std::string_view head) {
  return head.size() > 64 && head.substr(32).starts_with(kVersion) ? Match::yes : Match::no;
}

Document open_nms(const Contents& contents) {
  Cursor cursor(contents);
  cursor.seek(16);
  const double low = cursor.take<double>();
  const double high = cursor.take<double>();
  cursor.seek(kSizeAt);
  const double nx = cursor.take<std::uint32_t>();
  const double ny = cursor.take<std::uint32_t>();
  const double dx = cursor.take<double>() * 1e-9;
  const double dy = cursor.take<double>() * 1e-9;
  if (!std::isfinite(low) || !std::isfinite(high) || low > high) {
    reject(contents, fmt::format("heights from {} to {} um", low, high), "a range", kDamaged);
  }
  cursor.seek(kHeightsAt);
  check_size(contents, nx, ny, cursor.left() / sizeof(std::uint16_t));
  const Raster raster{
      .sample = Sample::u16, .nx = static_cast<Index>(nx), .ny = static_cast<Index>(ny)};
  const RowStep to_heights = [low, high](std::span<double> row) {
    for (double& z : row) z = low + z / kFullScale * (high - low);
  };
  const auto load = [contents, data = cursor.take(byte_size(raster)), raster, to_heights] {
    return decode(contents, data, raster, to_heights);
  };
  Document document{.format = "nms", .instrument = "NanoFocus"};
  const std::size_t picture = static_cast<std::size_t>(raster.nx * raster.ny);  // grey, a byte each
  if (cursor.left() >= picture) cursor.skip(picture);
  warn_of_surplus(cursor, document);
  document.layers.push_back({.name = "height",
                             .unit = "um",
                             .nx = raster.nx,
                             .ny = raster.ny,
                             .pixel_x = dx,
                             .pixel_y = dy,
                             .said_x = fmt::format("{:g} nm per column", dx * 1e9),
                             .said_y = fmt::format("{:g} nm per row", dy * 1e9),
                             .load = load});
  return document;
}

}  // namespace tabor::scan::format
