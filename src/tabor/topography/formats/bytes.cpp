#include "tabor/topography/formats/bytes.hpp"

#include <fmt/format.h>

#include "tabor/core/text.hpp"

namespace tabor::topography::format {
namespace {

template <typename T>
Field decode_as(std::string_view bytes, const Raster& raster) {
  const std::size_t stride =
      raster.row_stride ? raster.row_stride : static_cast<std::size_t>(raster.nx) * sizeof(T);
  Field field(raster.ny, raster.nx);
  for (Index y = 0; y < raster.ny; ++y) {
    const char* row = bytes.data() + static_cast<std::size_t>(y) * stride;
    for (Index x = 0; x < raster.nx; ++x) {
      T value;
      std::memcpy(&value, row + static_cast<std::size_t>(x) * sizeof(T), sizeof(T));
      field(y, x) = static_cast<double>(in_order(value, raster.order));
    }
  }
  return field;
}

}  // namespace

void Cursor::seek(std::size_t position) {
  position_ = 0;
  skip(position);
}

std::string_view Cursor::take(std::size_t n) {
  if (n > left()) {
    refuse(*contents_, fmt::format("only {} bytes", bytes_.size()),
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
    refuse(*contents_, fmt::format("no end of the text at byte {}", position_), "", kDamaged);
  }
  const std::string text(take(end - position_));
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
  const std::size_t row = static_cast<std::size_t>(raster.nx) * size_of(raster.sample);
  const std::size_t stride = raster.row_stride ? raster.row_stride : row;
  return static_cast<std::size_t>(raster.ny - 1) * stride + row;
}

Field decode(std::string_view bytes, const Raster& raster) {
  switch (raster.sample) {
    case Sample::u8:
      return decode_as<std::uint8_t>(bytes, raster);
    case Sample::i8:
      return decode_as<std::int8_t>(bytes, raster);
    case Sample::u16:
      return decode_as<std::uint16_t>(bytes, raster);
    case Sample::i16:
      return decode_as<std::int16_t>(bytes, raster);
    case Sample::u32:
      return decode_as<std::uint32_t>(bytes, raster);
    case Sample::i32:
      return decode_as<std::int32_t>(bytes, raster);
    case Sample::u64:
      return decode_as<std::uint64_t>(bytes, raster);
    case Sample::i64:
      return decode_as<std::int64_t>(bytes, raster);
    case Sample::f32:
      return decode_as<float>(bytes, raster);
    case Sample::f64:
      return decode_as<double>(bytes, raster);
  }
  return {};
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

}  // namespace tabor::topography::format
