// PGM, grey values as counts, plain (P2) or binary (P5): the user must say what a count and a pixel
// are.
#include <fmt/format.h>

#include <memory>

#include "tabor/core/text.hpp"
#include "tabor/scan/formats/bytes.hpp"
#include "tabor/scan/formats/readers.hpp"

namespace tabor::scan::format {
namespace {

constexpr double kMostGrey = 65535;

bool is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

/// Takes the next word; remarks run from '#' to the end of their line.
std::string_view take_word(std::string_view& text) {
  while (!text.empty() && (is_blank(text.front()) || text.front() == '#')) {
    const std::size_t n = text.front() == '#' ? std::min(text.find('\n'), text.size()) : 1;
    text.remove_prefix(n);
  }
  std::size_t end = 0;
  while (end < text.size() && !is_blank(text[end]) && text[end] != '#') ++end;
  const std::string_view word = text.substr(0, end);
  text.remove_prefix(end);
  return word;
}

double take_number(const Contents& contents, std::string_view& text, const char* what) {
  const std::string_view word = take_word(text);
  const auto number = parse_number(word);
  if (!number) {
    reject(contents, fmt::format("'{}' where its {} stands", word.substr(0, 40), what), "a number",
           kDamaged);
  }
  return *number;
}

/// Grey values written as text.
Field plain(const Contents& contents, std::string_view text, Index nx, Index ny) {
  Field counts(ny, nx);
  for (Index i = 0; i < counts.size(); ++i) {
    counts.data()[i] = take_number(contents, text, "grey value");
  }
  return counts;
}

}  // namespace

Match identify_pnm(std::string_view head) {
  const bool is_one = head.size() > 3 && head[0] == 'P' && head[1] >= '1' && head[1] <= '6';
  return is_one && (is_blank(head[2]) || head[2] == '#') ? Match::yes : Match::no;
}

Document open_pnm(const Contents& contents) {
  const char kind = contents.bytes[1];
  if (kind != '2' && kind != '5') {
    const bool is_bitmap = kind == '1' || kind == '4';
    reject(contents, is_bitmap ? "a picture of black and white" : "a colour picture",
           "grey values, one per pixel (PGM)", "save heights as 16-bit grey");
  }
  std::string_view rest = contents.bytes.substr(2);
  const double nx = take_number(contents, rest, "width");
  const double ny = take_number(contents, rest, "height");
  const double most = take_number(contents, rest, "largest grey value");
  if (!(most >= 1 && most <= kMostGrey)) {
    reject(contents, fmt::format("a largest grey value of {}", most), "1 to 65535", kDamaged);
  }
  Document document{.format = "pgm"};
  constexpr double kMostOfAByte = 255;
  if (most <= kMostOfAByte) {
    document.warnings.push_back(
        fmt::format("Heights are coarse, with only {} steps of grey", most));
  }
  const std::size_t size = most > kMostOfAByte ? 2 : 1;
  check_size(contents, nx, ny, rest.size() / size);
  Layer layer{.name = "grey values",
              .is_count = true,
              .nx = static_cast<Index>(nx),
              .ny = static_cast<Index>(ny)};
  if (kind == '2') {
    layer.load = [contents, rest, nx = layer.nx, ny = layer.ny] {
      return plain(contents, rest, nx, ny);
    };
  } else {
    Cursor cursor(contents);
    cursor.seek(contents.bytes.size() - rest.size() + 1);  // one blank behind the header
    const Raster raster{.sample = size == 2 ? Sample::u16 : Sample::u8,
                        .order = std::endian::big,
                        .nx = layer.nx,
                        .ny = layer.ny};
    layer.load = [contents, data = cursor.take(byte_size(raster)), raster] {
      return decode(contents, data, raster);
    };
    warn_of_surplus(cursor, document);
  }
  document.layers.push_back(std::move(layer));
  return document;
}

}  // namespace tabor::scan::format
