#include "tabor/scan/formats/bytes.hpp"

#include <fmt/format.h>

#include "tabor/core/rows.hpp"
#include "tabor/core/text.hpp"

namespace tabor::scan::format {
namespace {

/// Bytes decoded between two reports of progress.
constexpr std::size_t kWave = std::size_t{32} << 20;

template <typename T>
void decode_samples(const char* bytes, std::endian order, Index n, double* values) {
  for (Index i = 0; i < n; ++i) {
    T value;
    std::memcpy(&value, bytes + static_cast<std::size_t>(i) * sizeof(T), sizeof(T));
    values[i] = static_cast<double>(in_order(value, order));
  }
}

using Decoder = void (*)(const char* bytes, std::endian order, Index n, double* values);

Decoder decoder_of(Sample sample) {
  switch (sample) {
    case Sample::u8:
      return decode_samples<std::uint8_t>;
    case Sample::i8:
      return decode_samples<std::int8_t>;
    case Sample::u16:
      return decode_samples<std::uint16_t>;
    case Sample::i16:
      return decode_samples<std::int16_t>;
    case Sample::u32:
      return decode_samples<std::uint32_t>;
    case Sample::i32:
      return decode_samples<std::int32_t>;
    case Sample::u64:
      return decode_samples<std::uint64_t>;
    case Sample::i64:
      return decode_samples<std::int64_t>;
    case Sample::f32:
      return decode_samples<float>;
    case Sample::f64:
      break;
  }
  return decode_samples<double>;
}

std::size_t stride_of(const Raster& raster) {
  return raster.row_stride ? raster.row_stride
                           : static_cast<std::size_t>(raster.nx) * size_of(raster.sample);
}

}  // namespace

void Cursor::seek(std::size_t position) {
  position_ = 0;
  skip(position);
}

std::string_view Cursor::take(std::size_t n) {
  if (n > left()) {
    reject(*contents_, fmt::format("only {} bytes", bytes_.size()),
           fmt::format("{} bytes after byte {}", n, position_), kDamaged);
  }
  const std::string_view taken = bytes_.substr(position_, n);
  position_ += n;
  return taken;
}

std::string Cursor::take_text(std::size_t width) {
  const std::string_view field = take(width);
  return std::string(trim(field.substr(0, std::min(field.find('\0'), width))));
}

std::string Cursor::take_terminated() {
  const std::size_t end = bytes_.find('\0', position_);
  if (end == std::string_view::npos) {
    reject(*contents_, fmt::format("no end of the text at byte {}", position_), "", kDamaged);
  }
  std::string text(take(end - position_));
  skip(1);
  return text;
}

std::size_t size_of(Sample sample) {
  switch (sample) {
    case Sample::u8:
    case Sample::i8:
      return 1;
    case Sample::u16:
    case Sample::i16:
      return 2;
    case Sample::u32:
    case Sample::i32:
    case Sample::f32:
      return 4;
    case Sample::u64:
    case Sample::i64:
    case Sample::f64:
      return 8;
  }
  return 8;
}

bool is_integer(Sample sample) { return sample != Sample::f32 && sample != Sample::f64; }

std::size_t byte_size(const Raster& raster) {
  return static_cast<std::size_t>(raster.ny - 1) * stride_of(raster) +
         static_cast<std::size_t>(raster.nx) * size_of(raster.sample);
}

Field decode(const Contents& contents, std::string_view bytes, const Raster& raster,
             const RowStep& step) {
  const Decoder decoder = decoder_of(raster.sample);
  const std::size_t stride = stride_of(raster);
  const Index rows_per_wave = static_cast<Index>(std::max<std::size_t>(1, kWave / stride));
  Field field(raster.ny, raster.nx);
  for (Index first = 0; first < raster.ny; first += rows_per_wave) {
    const Index n_rows = std::min(rows_per_wave, raster.ny - first);
    const std::string_view wave = bytes.substr(static_cast<std::size_t>(first) * stride);
    for_each_row(n_rows, [&](Index y) {
      double* row = &field(first + y, 0);
      decoder(wave.data() + static_cast<std::size_t>(y) * stride, raster.order, raster.nx, row);
      if (step) step({row, static_cast<std::size_t>(raster.nx)});
    });
    contents.finished(wave.substr(0, static_cast<std::size_t>(n_rows) * stride),
                      static_cast<double>(first + n_rows) / static_cast<double>(raster.ny));
  }
  return field;
}

void RowDecoder::accept(std::string_view bytes) {
  const Decoder decoder = decoder_of(raster_.sample);
  const std::size_t size = size_of(raster_.sample);
  const auto add = [&](std::string_view samples) {
    const Index n =
        std::min(static_cast<Index>(samples.size() / size), field_->size() - n_decoded_);
    decoder(samples.data(), raster_.order, n, field_->data() + n_decoded_);
    n_decoded_ += n;
  };
  if (!rest_.empty()) {
    const std::size_t missing = std::min(size - rest_.size(), bytes.size());
    rest_ += bytes.substr(0, missing);
    bytes.remove_prefix(missing);
    if (rest_.size() < size) return;
    add(rest_);
    rest_.clear();
  }
  add(bytes);
  rest_ = bytes.substr(bytes.size() / size * size);
}

void warn_of_surplus(const Cursor& behind_map, Document& document) {
  if (behind_map.left() == 0) return;
  document.warnings.push_back(fmt::format(
      "{} bytes follow the map. The file may state a wrong size or type", behind_map.left()));
}

void warn_of_negative_scale(double scale, Document& document) {
  if (scale < 0) document.warnings.push_back("The height scale is negative. Check that up is up");
}

namespace {

/// Bytes of the UTF-8 character that `text` begins with; 0 if there is none.
std::size_t character_size(std::string_view text) {
  const auto first = static_cast<unsigned char>(text[0]);
  const std::size_t size = first < 0x80   ? 1
                           : first < 0xc2 ? 0
                           : first < 0xe0 ? 2
                           : first < 0xf0 ? 3
                           : first < 0xf5 ? 4
                                          : 0;
  if (size > text.size()) return 0;
  const bool continues = std::all_of(
      text.begin() + 1, text.begin() + static_cast<std::ptrdiff_t>(std::max<std::size_t>(size, 1)),
      [](char c) { return (static_cast<unsigned char>(c) & 0xc0) == 0x80; });
  return continues ? size : 0;
}

}  // namespace

std::string writable_text(std::string_view text, std::size_t most_bytes) {
  std::string result;
  while (!text.empty()) {
    const std::size_t size = character_size(text);
    const auto first = static_cast<unsigned char>(text[0]);
    const bool is_control = first < 0x20 || first == 0x7f;
    const std::string_view character = size == 0 ? "?" : is_control ? " " : text.substr(0, size);
    if (result.size() + character.size() > most_bytes) break;
    result += character;
    text.remove_prefix(std::max<std::size_t>(size, 1));
  }
  return result;
}

void put_text(std::string& bytes, std::string_view text, std::size_t width, char fill) {
  std::string field(text.substr(0, width));
  field.resize(width, fill);
  bytes += field;
}

void put_field(std::string& bytes, const Field& field) {
  bytes.append(reinterpret_cast<const char*>(field.data()),
               static_cast<std::size_t>(field.size()) * sizeof(double));
}

void put_field_f32(std::string& bytes, const Field& field) {
  const FieldF values = field.cast<float>();
  bytes.append(reinterpret_cast<const char*>(values.data()),
               static_cast<std::size_t>(values.size()) * sizeof(float));
}

}  // namespace tabor::scan::format
