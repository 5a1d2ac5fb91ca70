// MetroPro .dat of Zygo interferometers; big-endian.
#include <fmt/format.h>

#include <cmath>

#include "tabor/scan/formats/bytes.hpp"
#include "tabor/scan/formats/readers.hpp"

namespace tabor::scan::format {
namespace {

constexpr std::string_view kMagic{"\x88\x1b\x03", 3};
constexpr double kMissing = 2147483640;
constexpr std::int32_t kLeastHeader = 834;  // of format 1; later ones are longer

/// Counts per half wavelength for the resolution codes 0, 1, 2.
double resolution(const Contents& contents, int code) {
  switch (code) {
    case 0:
      return 4096;
    case 1:
      return 32768;
    case 2:
      return 131072;
    default:
      reject(contents, fmt::format("phase resolution code {}", code), "0, 1 or 2", kDamaged);
  }
}

}  // namespace

Match identify_metropro(std::string_view head) {
  const bool known =
      head.size() > 3 && head.starts_with(kMagic) && head[3] >= 0x6F && head[3] <= 0x71;
  return known ? Match::yes : Match::no;
}

Document open_metropro(const Contents& contents) {
  Cursor cursor(contents, std::endian::big);
  cursor.seek(6);
  const auto header_size = cursor.take<std::int32_t>();
  cursor.seek(52);
  const auto n_intensities = std::size_t{cursor.take<std::uint16_t>()} *
                             cursor.take<std::uint16_t>() * cursor.take<std::uint16_t>();
  cursor.seek(60);
  const auto intensity_size = cursor.take<std::uint32_t>();
  cursor.seek(68);
  const double nx = cursor.take<std::uint16_t>();
  const double ny = cursor.take<std::uint16_t>();
  const double phase_size = cursor.take<std::uint32_t>();
  const bool sizes_agree =
      intensity_size == 2 * n_intensities && phase_size == nx * ny * sizeof(std::int32_t);
  const double file_size = static_cast<double>(header_size) + intensity_size + phase_size;
  if (!sizes_agree && file_size != static_cast<double>(contents.bytes.size())) {
    reject(contents,
           fmt::format("{} bytes of intensity and {} of phase", intensity_size, phase_size),
           fmt::format("{} and {}, as their sizes say", 2 * n_intensities,
                       nx * ny * sizeof(std::int32_t)),
           kDamaged);
  }
  cursor.seek(164);
  const double scale = cursor.take<float>();
  const double wavelength = cursor.take<float>();
  cursor.seek(176);
  const double obliquity = cursor.take<float>();
  cursor.seek(184);
  const double pixel = cursor.take<float>();
  cursor.seek(218);
  const double counts = resolution(contents, cursor.take<std::int16_t>());
  cursor.seek(232);
  const double sign = cursor.take<std::int16_t>() != 0 ? -1 : 1;  // heights stored downwards
  const double metres_per_count = sign * scale * wavelength * obliquity / counts;
  if (header_size < kLeastHeader || !std::isfinite(metres_per_count) || metres_per_count == 0) {
    reject(contents, "a header without a height scale", "a MetroPro phase map", kDamaged);
  }
  constexpr double kShortest = 1e-7, kLongest = 1e-4;  // light, generously
  if (!(wavelength >= kShortest && wavelength <= kLongest)) {
    reject(contents, fmt::format("a wavelength of {} m", wavelength), "that of light", kDamaged);
  }
  cursor.seek(static_cast<std::size_t>(header_size) + intensity_size);
  check_size(contents, nx, ny, cursor.left() / sizeof(std::int32_t));
  const Raster raster{.sample = Sample::i32,
                      .order = std::endian::big,
                      .nx = static_cast<Index>(nx),
                      .ny = static_cast<Index>(ny)};
  const auto load = [contents, data = cursor.take(byte_size(raster)), raster] {
    return decode(contents, data, raster, holes_where([](double z) { return z >= kMissing; }));
  };
  // A file without lateral calibration says 0.
  const bool calibrated = pixel != 0;
  Document document{.format = "metropro", .instrument = "Zygo"};
  warn_of_surplus(cursor, document);
  warn_of_negative_scale(sign * metres_per_count, document);
  document.layers.push_back({.name = "phase",
                             .unit = "m",
                             .scale = metres_per_count,
                             .nx = raster.nx,
                             .ny = raster.ny,
                             .pixel_x = calibrated ? std::optional(pixel) : std::nullopt,
                             .pixel_y = calibrated ? std::optional(pixel) : std::nullopt,
                             .said_x = "its lateral resolution",
                             .said_y = "its lateral resolution",
                             .load = load});
  return document;
}

}  // namespace tabor::scan::format
