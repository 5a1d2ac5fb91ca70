// BCR and BCRF of Image Metrology (SPIP): 2048 characters of text, then integers or floats.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

#include "tabor/core/text.hpp"
#include "tabor/core/units.hpp"
#include "tabor/scan/formats/bytes.hpp"
#include "tabor/scan/formats/readers.hpp"
#include "tabor/scan/formats/text_numbers.hpp"

namespace tabor::scan::format {
namespace {

constexpr std::size_t kHeaderCharacters = 2048;
constexpr std::string_view kFirstKey = "fileformat=bcr";
/// Void pixels of the float format hold the largest float; nothing that is a height is near it.
constexpr double kVoidFloat = 1e38;
constexpr double kVoidInteger = 32767;

using Keys = std::map<std::string, std::string>;

/// The header in UTF-8. Some programs write UTF-16 without its mark.
std::string header_text(std::string_view bytes) {
  if (const auto marked = utf8_from_utf16(bytes.substr(0, 2 * kHeaderCharacters))) return *marked;
  if (bytes.size() > 1 && bytes[1] == '\0') {
    return *utf8_from_utf16("\xFF\xFE" + std::string(bytes.substr(0, 2 * kHeaderCharacters)));
  }
  std::string text(bytes.substr(0, kHeaderCharacters));
  std::replace(text.begin(), text.end(), '\0', '\n');  // padding behind the last key
  return text;
}

bool is_wide(std::string_view bytes) {
  return bytes.starts_with("\xFF\xFE") || (bytes.size() > 1 && bytes[1] == '\0');
}

Keys keys_of(const std::string& text) {
  Keys keys;
  std::string_view rest = text;
  while (!rest.empty()) {
    const std::string_view line = take_line(rest);
    const std::size_t equals = line.find('=');
    if (line.starts_with('%') || equals == std::string_view::npos) continue;
    keys.emplace(lower(trim(line.substr(0, equals))), trim(line.substr(equals + 1)));
  }
  return keys;
}

std::string text_of(const Keys& keys, const std::string& key, const std::string& fallback) {
  const auto item = keys.find(key);
  return item == keys.end() || item->second.empty() ? fallback : item->second;
}

double number(const Contents& contents, const Keys& keys, const std::string& key,
              std::optional<double> fallback = std::nullopt) {
  const auto item = keys.find(key);
  const auto value = item == keys.end() ? fallback : parse_number(item->second);
  if (!value || !std::isfinite(*value)) {
    reject(contents, fmt::format("no number '{}'", key), "a BCR header", kDamaged);
  }
  return *value;
}

std::string said(const Keys& keys, char axis) {
  const std::string key = std::string(1, axis) + "length";
  return fmt::format("{} {} {}", key, text_of(keys, key, ""),
                     text_of(keys, std::string(1, axis) + "unit", "nm"));
}

std::optional<double> pixel(const Keys& keys, char axis, double n) {
  const auto length = stated_number(text_of(keys, std::string(1, axis) + "length", ""));
  if (!length) return std::nullopt;
  const std::string unit = text_of(keys, std::string(1, axis) + "unit", "nm");
  return *length * unit_factor(unit, dimension::length).value_or(kHole) / n;
}

}  // namespace

Match identify_bcr(std::string_view head) {
  std::string start = header_text(head.substr(0, 2 * kFirstKey.size() + 16));
  std::erase(start, ' ');
  return start.starts_with(kFirstKey) ? Match::yes : Match::no;
}

Document open_bcr(const Contents& contents) {
  const Keys keys = keys_of(header_text(contents.bytes));
  const std::string kind = lower(text_of(keys, "fileformat", ""));
  const bool is_float = kind == "bcrf" || kind == "bcrf_unicode";
  if (!is_float && kind != "bcrstm" && kind != "bcrstm_unicode") {
    reject(contents, "fileformat '" + kind + "'", "bcrstm or bcrf");
  }
  const bool is_little = number(contents, keys, "intelmode", 1) != 0;
  Raster raster{.sample = is_float ? Sample::f32 : Sample::i16,
                .order = is_little ? std::endian::little : std::endian::big};
  const double characters = number(contents, keys, "headersize", kHeaderCharacters);
  const std::size_t width = is_wide(contents.bytes) ? 2 : 1;
  if (characters != kHeaderCharacters &&
      characters != static_cast<double>(width * kHeaderCharacters)) {
    reject(contents, fmt::format("a header of {} characters", characters), "2048", kDamaged);
  }
  Cursor cursor(contents);
  cursor.seek(width * kHeaderCharacters);
  const double nx = number(contents, keys, "xpixels");
  const double ny = number(contents, keys, "ypixels");
  check_size(contents, nx, ny, cursor.left() / size_of(raster.sample));
  raster.nx = static_cast<Index>(nx);
  raster.ny = static_cast<Index>(ny);
  const bool has_void = number(contents, keys, "voidpixels", 0) != 0;
  const auto is_void = [is_float, has_void](double z) {
    return is_float ? std::abs(z) >= kVoidFloat : has_void && z == kVoidInteger;
  };
  Document document{.format = "bcr"};
  document.metadata = keys;
  Layer layer{.name = "height", .unit = text_of(keys, "zunit", "nm")};
  layer.scale = is_float ? number(contents, keys, "bit2nm", 1) : number(contents, keys, "bit2nm");
  if (layer.scale == 0) reject(contents, "a bit2nm of 0", "a height per count", kDamaged);
  layer.nx = raster.nx;
  layer.ny = raster.ny;
  layer.pixel_x = pixel(keys, 'x', nx);
  layer.pixel_y = pixel(keys, 'y', ny);
  layer.said_x = said(keys, 'x');
  layer.said_y = said(keys, 'y');
  layer.load = [contents, data = cursor.take(byte_size(raster)), raster, is_void] {
    return decode(contents, data, raster, holes_where(is_void));
  };
  warn_of_surplus(cursor, document);
  warn_of_negative_scale(layer.scale, document);
  document.layers.push_back(std::move(layer));
  return document;
}

}  // namespace tabor::scan::format
