// AL3D, Alicona Imaging: text tags, then images at offsets the tags name.
#include <fmt/format.h>

#include <cmath>
#include <map>

#include "tabor/core/text.hpp"
#include "tabor/scan/formats/bytes.hpp"
#include "tabor/scan/formats/readers.hpp"

namespace tabor::scan::format {
namespace {

constexpr std::string_view kMagic{"AliconaImaging\0\r\n", 17};
constexpr std::size_t kRowAlignment = 8;
/// The file prints InvalidPixelValue with fewer digits than its float32 heights have.
constexpr double kSameValue = 1.5e-7;

using Tags = std::map<std::string, std::string>;

Tags take_tags(Cursor& cursor) {
  cursor.skip(kMagic.size());
  Tags tags;
  double n_left = 2;  // Version and TagCount come before the tags that are counted
  while (n_left-- > 0) {
    const std::string key = cursor.take_text(20);
    tags[key] = cursor.take_text(30);
    cursor.skip(2);
    if (key == "TagCount") n_left += parse_number(tags[key]).value_or(0);
  }
  return tags;
}

std::string text_of(const Tags& tags, const std::string& key) {
  const auto tag = tags.find(key);
  return tag == tags.end() ? "" : tag->second;
}

std::optional<double> stated(const Tags& tags, const std::string& key) {
  return stated_number(text_of(tags, key));
}

double number(const Contents& contents, const Tags& tags, const std::string& key) {
  const auto tag = tags.find(key);
  const auto value = tag == tags.end() ? std::nullopt : parse_number(tag->second);
  if (!value || !std::isfinite(*value)) {
    reject(contents, "no number " + key, "a depth image", kDamaged);
  }
  return *value;
}

}  // namespace

Match identify_al3d(std::string_view head) {
  return head.starts_with(kMagic) ? Match::yes : Match::no;
}

Document open_al3d(const Contents& contents) {
  Cursor cursor(contents);
  const Tags tags = take_tags(cursor);
  const double nx = number(contents, tags, "Cols");
  const double ny = number(contents, tags, "Rows");
  const double offset = number(contents, tags, "DepthImageOffset");
  const auto mark = tags.find("InvalidPixelValue");  // none or NaN: only NaN is invalid
  const double invalid = mark == tags.end() ? kHole : parse_number(mark->second).value_or(kHole);
  if (!(offset >= static_cast<double>(cursor.position()) &&
        offset < static_cast<double>(contents.bytes.size())) ||
      offset != std::floor(offset)) {
    reject(contents, fmt::format("a depth image at byte {}", offset),
           fmt::format("one behind the header of {} bytes", cursor.position()), kDamaged);
  }
  cursor.seek(static_cast<std::size_t>(offset));
  check_size(contents, nx, ny, cursor.left() / sizeof(float));
  Raster raster{.sample = Sample::f32, .nx = static_cast<Index>(nx), .ny = static_cast<Index>(ny)};
  const std::size_t row = static_cast<std::size_t>(raster.nx) * sizeof(float);
  raster.row_stride = (row + kRowAlignment - 1) / kRowAlignment * kRowAlignment;
  const std::string_view data = cursor.take(byte_size(raster));
  const auto is_invalid = [invalid](double z) {
    return std::abs(z - invalid) <= kSameValue * std::abs(invalid);
  };
  const auto application = tags.find("CreatingApplication");
  Document document{.format = "al3d", .instrument = "Alicona"};
  if (application != tags.end()) document.metadata["CreatingApplication"] = application->second;
  document.layers.push_back({.name = "depth",
                             .unit = "m",
                             .nx = raster.nx,
                             .ny = raster.ny,
                             .pixel_x = stated(tags, "PixelSizeXMeter"),
                             .pixel_y = stated(tags, "PixelSizeYMeter"),
                             .said_x = "PixelSizeXMeter " + text_of(tags, "PixelSizeXMeter"),
                             .said_y = "PixelSizeYMeter " + text_of(tags, "PixelSizeYMeter"),
                             .load = [contents, data, raster, is_invalid] {
                               return decode(contents, data, raster, holes_where(is_invalid));
                             }});
  return document;
}

}  // namespace tabor::scan::format
