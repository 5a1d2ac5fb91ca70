#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

#include "tabor/scan/formats/format.hpp"

// Reads numbers and rasters of samples from the bytes of a file, and appends them.
namespace tabor::scan::format {

static_assert(std::endian::native == std::endian::little,
              "the byte order of files is converted assuming a little-endian machine");

/// Reverses the bytes of a number if the file's order is not the machine's.
template <typename T>
T in_order(T value, std::endian order) {
  if (order == std::endian::native) return value;
  std::array<char, sizeof(T)> bytes;
  std::memcpy(bytes.data(), &value, sizeof(T));
  std::reverse(bytes.begin(), bytes.end());
  std::memcpy(&value, bytes.data(), sizeof(T));
  return value;
}

/// Reads the bytes of a file in order and never reads beyond them.
class Cursor {
 public:
  explicit Cursor(const Contents& contents, std::endian order = std::endian::little)
      : contents_(&contents), bytes_(contents.bytes), order_(order) {}

  std::size_t position() const { return position_; }
  std::size_t left() const { return bytes_.size() - position_; }
  void seek(std::size_t position);
  void skip(std::size_t n) { take(n); }

  /// Returns the next n bytes. Throws InputError (truncated) if the file ends before.
  std::string_view take(std::size_t n);

  template <typename T>
  T take() {
    T value;
    std::memcpy(&value, take(sizeof(T)).data(), sizeof(T));
    return in_order(value, order_);
  }

  /// Returns a text field of fixed width, up to its first NUL, without surrounding blanks.
  std::string take_text(std::size_t width);
  /// Returns text up to and without its terminating NUL.
  std::string take_terminated();

 private:
  const Contents* contents_;
  std::string_view bytes_;
  std::endian order_;
  std::size_t position_ = 0;
};

enum class Sample { u8, i8, u16, i16, u32, i32, u64, i64, f32, f64 };

std::size_t size_of(Sample sample);
bool is_integer(Sample sample);

/// Layout of the samples of a map in the bytes.
struct Raster {
  Sample sample = Sample::f64;
  std::endian order = std::endian::little;
  Index nx = 0;
  Index ny = 0;
  std::size_t row_stride = 0;  ///< [bytes] from row to row, 0 = rows without gaps
};

/// Returns the number of bytes that the raster covers.
std::size_t byte_size(const Raster& raster);

/// Changes one row of decoded samples, for instance makes holes of marked values.
using RowStep = std::function<void(std::span<double> row)>;

/// Makes holes of the samples for which is_hole(sample) is true.
template <typename IsHole>
RowStep holes_where(IsHole is_hole) {
  return [is_hole](std::span<double> row) {
    for (double& sample : row) {
      if (is_hole(sample)) sample = kHole;
    }
  };
}

/// Decodes `bytes` (at least byte_size(raster), checked before) to numbers, shape (ny, nx), on all
/// threads. Decoded pages of the file are released, so that the map is not in memory twice. Throws
/// Interrupted.
Field decode(const Contents& contents, std::string_view bytes, const Raster& raster,
             const RowStep& step = {});

/// Decodes samples that come piece after piece, as from an archive: accepts the next bytes, of any
/// length; `field` must have the raster's shape. Rows without gaps only.
class RowDecoder {
 public:
  RowDecoder(const Raster& raster, Field& field) : raster_(raster), field_(&field) {}
  void accept(std::string_view bytes);

 private:
  Raster raster_;
  Field* field_;
  std::string rest_;     ///< bytes of a sample that is not complete
  Index n_decoded_ = 0;  ///< samples
};

/// Appends the little-endian bytes of a number.
template <typename T>
void put(std::string& bytes, T value) {
  static_assert(std::is_arithmetic_v<T>);
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(T));
}

/// Adds a warning that bytes follow the map: its size may be wrong.
void warn_of_surplus(const Cursor& behind_map, Document& document);

/// Adds a warning that a negative height scale turns the surface upside down.
void warn_of_negative_scale(double scale, Document& document);

/// Returns text that any format can hold, in at most `most_bytes`: one line, valid UTF-8, no
/// character cut.
std::string writable_text(std::string_view text, std::size_t most_bytes = std::string_view::npos);

/// Appends text cut or padded with `fill` to a fixed width.
void put_text(std::string& bytes, std::string_view text, std::size_t width, char fill = ' ');

/// Appends all values as float64 (or float32), row by row.
void put_field(std::string& bytes, const Field& field);
void put_field_f32(std::string& bytes, const Field& field);

}  // namespace tabor::scan::format
