// The only file that knows libtiff.
#include "tabor/io/image/tiff.hpp"

#include <fmt/format.h>
#include <tiffio.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "tabor/core/error.hpp"
#include "tabor/core/text.hpp"
#include "tabor/io/files/atomic_file.hpp"

namespace tabor::io {
namespace {

constexpr std::uint32_t kParkTag = 50434;
constexpr std::uint32_t kMissingTag = 42113;  // "GDAL_NODATA", a number as text
/// No row or tag of a height map is larger: keeps forged sizes from taking all memory.
constexpr tmsize_t kMaxAllocation = tmsize_t{1} << 28;

/// Keeps the first error of libtiff, which would print it.
int note_error(TIFF*, void* message, const char*, const char* format, va_list arguments) {
  auto& text = *static_cast<std::string*>(message);
  std::array<char, 200> buffer{};
  if (text.empty()) {
    std::vsnprintf(buffer.data(), buffer.size(), format, arguments);
    text = buffer.data();
  }
  return 1;
}

int ignore_warning(TIFF*, void*, const char*, const char*, va_list) { return 1; }

/// Opens a file; null, and the reason in `message`, if that fails.
TIFF* open(const std::filesystem::path& file, const char* mode, std::string& message) {
  const std::unique_ptr<TIFFOpenOptions, decltype(&TIFFOpenOptionsFree)> options(
      TIFFOpenOptionsAlloc(), &TIFFOpenOptionsFree);
  TIFFOpenOptionsSetErrorHandlerExtR(options.get(), &note_error, &message);
  TIFFOpenOptionsSetWarningHandlerExtR(options.get(), &ignore_warning, nullptr);
  TIFFOpenOptionsSetMaxSingleMemAlloc(options.get(), kMaxAllocation);
  return TIFFOpenExt(file.c_str(), mode, options.get());
}

/// An open TIFF file.
class Tiff {
 public:
  explicit Tiff(const std::filesystem::path& file) : name_(file.string()) {
    tiff_ = open(file, "r", message_);
    if (tiff_ == nullptr) fail();
  }
  ~Tiff() {
    if (tiff_ != nullptr) TIFFClose(tiff_);
  }
  Tiff(const Tiff&) = delete;
  Tiff& operator=(const Tiff&) = delete;

  operator TIFF*() const { return tiff_; }

  template <typename T>
  T number(std::uint32_t tag, T fallback) const {
    T value{};
    return TIFFGetFieldDefaulted(tiff_, tag, &value) == 1 ? value : fallback;
  }

  [[noreturn]] void fail() const {
    throw InputError(name_, "a damaged TIFF" + (message_.empty() ? "" : " (" + message_ + ")"), "",
                     "export or copy it again");
  }
  [[noreturn]] void reject(const std::string& got, const std::string& expected) const {
    throw InputError(name_, got, expected, "save it as 16-bit grey without tiles");
  }

 private:
  std::string name_;
  mutable std::string message_;
  TIFF* tiff_ = nullptr;
};

TiffDescription describe(const Tiff& tiff) {
  TiffDescription image;
  image.nx = tiff.number<std::uint32_t>(TIFFTAG_IMAGEWIDTH, 0);
  image.ny = tiff.number<std::uint32_t>(TIFFTAG_IMAGELENGTH, 0);
  image.n_channels = tiff.number<std::uint16_t>(TIFFTAG_SAMPLESPERPIXEL, 1);
  image.bits = tiff.number<std::uint16_t>(TIFFTAG_BITSPERSAMPLE, 1);
  image.is_float =
      tiff.number<std::uint16_t>(TIFFTAG_SAMPLEFORMAT, SAMPLEFORMAT_UINT) == SAMPLEFORMAT_IEEEFP;
  const auto meaning = tiff.number<std::uint16_t>(TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_RGB);
  image.white_is_zero = meaning == PHOTOMETRIC_MINISWHITE;
  image.is_grey =
      image.n_channels == 1 && (image.white_is_zero || meaning == PHOTOMETRIC_MINISBLACK);
  image.is_compressed =
      tiff.number<std::uint16_t>(TIFFTAG_COMPRESSION, COMPRESSION_NONE) != COMPRESSION_NONE;
  image.is_tiled = TIFFIsTiled(tiff) != 0;
  image.starts_top_left =
      tiff.number<std::uint16_t>(TIFFTAG_ORIENTATION, ORIENTATION_TOPLEFT) == ORIENTATION_TOPLEFT;
  const char* text = nullptr;
  if (TIFFGetField(tiff, TIFFTAG_IMAGEDESCRIPTION, &text) == 1 && text != nullptr) {
    image.text = text;
  }
  image.has_park_tags = TIFFFindField(tiff, kParkTag, TIFF_ANY) != nullptr;
  return image;
}

template <typename T>
void convert(const std::vector<char>& bytes, Index n, double* row) {
  for (Index x = 0; x < n; ++x) {
    T value;
    std::memcpy(&value, bytes.data() + static_cast<std::size_t>(x) * sizeof(T), sizeof(T));
    row[x] = static_cast<double>(value);
  }
}

using Convert = void (*)(const std::vector<char>& bytes, Index n, double* row);

Convert converter(const Tiff& tiff, const TiffDescription& image) {
  const bool is_signed =
      tiff.number<std::uint16_t>(TIFFTAG_SAMPLEFORMAT, SAMPLEFORMAT_UINT) == SAMPLEFORMAT_INT;
  if (image.is_float && image.bits == 32) return convert<float>;
  if (image.is_float && image.bits == 64) return convert<double>;
  if (!image.is_float && image.bits == 8) {
    return is_signed ? convert<std::int8_t> : convert<std::uint8_t>;
  }
  if (!image.is_float && image.bits == 16) {
    return is_signed ? convert<std::int16_t> : convert<std::uint16_t>;
  }
  if (!image.is_float && image.bits == 32) {
    return is_signed ? convert<std::int32_t> : convert<std::uint32_t>;
  }
  tiff.reject(fmt::format("{} bits per sample", image.bits), "8, 16 or 32, or floats");
}

/// The sample that stands for a missing one, or NaN.
double missing_sample(const Tiff& tiff, const TiffDescription& image) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  const TIFFField* field = TIFFFindField(tiff, kMissingTag, TIFF_ANY);
  if (field == nullptr || TIFFFieldDataType(field) != TIFF_ASCII) return none;
  std::uint32_t size = 0;
  const char* text = nullptr;
  if (TIFFGetField(tiff, kMissingTag, &size, &text) != 1 || text == nullptr) return none;
  const double value = parse_number(std::string(text, strnlen(text, size))).value_or(none);
  const bool is_single = image.is_float && image.bits == 32;
  // Samples cannot equal what single precision cannot hold.
  if (is_single && std::abs(value) > std::numeric_limits<float>::max()) return none;
  return is_single ? static_cast<float>(value) : value;
}

}  // namespace

TiffDescription describe_tiff(const std::filesystem::path& file) {
  const Tiff tiff(file);
  TiffDescription image = describe(tiff);
  constexpr int kEnough = 1000;  // a chain of directories may be forged to be endless
  while (image.n_images < kEnough && TIFFReadDirectory(tiff) == 1) ++image.n_images;
  return image;
}

Field read_tiff(const std::filesystem::path& file, const std::function<void(double)>& progress) {
  const Tiff tiff(file);
  const TiffDescription image = describe(tiff);
  if (!image.is_grey) tiff.reject("a colour image", "grey values, one per pixel");
  if (image.is_tiled) tiff.reject("an image in tiles", "rows");
  if (!image.starts_top_left) tiff.reject("a turned image", "rows from the top left");
  const Convert convert_row = converter(tiff, image);
  const double missing = missing_sample(tiff, image);
  const auto row_bytes = static_cast<std::size_t>(image.nx * image.bits / 8);
  if (image.nx < 1 || image.ny < 1 || TIFFScanlineSize64(tiff) != row_bytes) tiff.fail();
  std::vector<char> bytes(row_bytes);
  Field samples(image.ny, image.nx);
  for (Index y = 0; y < image.ny; ++y) {
    if (TIFFReadScanline(tiff, bytes.data(), static_cast<std::uint32_t>(y)) != 1) tiff.fail();
    convert_row(bytes, image.nx, &samples(y, 0));
    std::replace(&samples(y, 0), &samples(y, 0) + image.nx, missing,
                 std::numeric_limits<double>::quiet_NaN());
    constexpr Index kRowsPerReport = 256;
    if (progress && (y + 1) % kRowsPerReport == 0) {
      progress(static_cast<double>(y + 1) / static_cast<double>(image.ny));
    }
  }
  return samples;
}

namespace {

/// Declares GDAL's tag, which libtiff does not know. The library points to the name.
void declare_missing_tag(TIFF* tiff) {
  static char name[] = "GDALNoDataValue";
  const TIFFFieldInfo field{kMissingTag, TIFF_VARIABLE, TIFF_VARIABLE, TIFF_ASCII, FIELD_CUSTOM, 1,
                            0,           name};
  TIFFMergeFieldInfo(tiff, &field, 1);
}

void set_tags(TIFF* tiff, const Field& map, const std::string& text) {
  constexpr int kBits = 32;
  TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, static_cast<std::uint32_t>(map.cols()));
  TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, static_cast<std::uint32_t>(map.rows()));
  TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, kBits);
  TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, 1);
  TIFFSetField(tiff, TIFFTAG_SAMPLEFORMAT, SAMPLEFORMAT_IEEEFP);
  TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK);
  TIFFSetField(tiff, TIFFTAG_ORIENTATION, ORIENTATION_TOPLEFT);
  TIFFSetField(tiff, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
  TIFFSetField(tiff, TIFFTAG_ROWSPERSTRIP, TIFFDefaultStripSize(tiff, 0));
  TIFFSetField(tiff, TIFFTAG_IMAGEDESCRIPTION, text.c_str());
  declare_missing_tag(tiff);
  TIFFSetField(tiff, kMissingTag, "nan");
}

bool write_rows(TIFF* tiff, const Field& map) {
  for (Index y = 0; y < map.rows(); ++y) {
    FieldF row = map.row(y).cast<float>();
    if (TIFFWriteScanline(tiff, row.data(), static_cast<std::uint32_t>(y)) != 1) return false;
  }
  return TIFFFlush(tiff) == 1;
}

}  // namespace

void write_tiff(const Field& map, const std::string& text, const std::filesystem::path& file) {
  TemporaryFile temporary(file);
  constexpr Index kLargeMap = Index{1} << 29;  // beyond, offsets need 64 bits
  std::string message;
  TIFF* tiff = open(temporary.path(), map.size() < kLargeMap ? "w" : "w8", message);
  bool is_written = tiff != nullptr;
  if (is_written) {
    set_tags(tiff, map, text);
    is_written = write_rows(tiff, map);
    TIFFClose(tiff);
  }
  if (!is_written || !message.empty()) {
    throw OutputError(file.string() + ": cannot write: " + message);
  }
  temporary.commit();
}

}  // namespace tabor::io
