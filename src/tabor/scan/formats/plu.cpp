// PLU, Sensofar confocal and interference profilers.
#include <fmt/format.h>

#include <cmath>

#include "tabor/scan/formats/bytes.hpp"
#include "tabor/scan/formats/readers.hpp"

namespace tabor::scan::format {
namespace {

constexpr std::size_t kHeaderSize = 500;
constexpr double kMissing = 1000001;
constexpr std::uint32_t kTopography = 3;

}  // namespace

/// No magic number: the date text, a plausible map size and the measurement type must fit.
Match identify_plu(std::string_view head) {
  if (head.size() < kHeaderSize + 8) return Match::no;
  const Contents contents{"", head};
  Cursor cursor(contents);
  for (const char c : cursor.take_text(128)) {
    if (static_cast<unsigned char>(c) < ' ') return Match::no;
  }
  cursor.seek(388);
  const auto ny = cursor.take<std::uint32_t>();
  const auto nx = cursor.take<std::uint32_t>();
  cursor.seek(428);
  const auto type = cursor.take<std::uint32_t>();
  cursor.seek(kHeaderSize);
  const bool same_size = cursor.take<std::uint32_t>() == ny && cursor.take<std::uint32_t>() == nx;
  return type == kTopography && nx > 0 && ny > 0 && same_size ? Match::yes : Match::no;
}

Document open_plu(const Contents& contents) {
  Cursor cursor(contents);
  Document document{.format = "plu", .instrument = "Sensofar"};
  document.metadata["Date"] = cursor.take_text(128);
  cursor.seek(404);
  const double dx = cursor.take<float>() * 1e-6;
  const double dy = cursor.take<float>() * 1e-6;
  cursor.seek(489);
  if (const int n_layers = cursor.take<std::uint8_t>(); n_layers > 1) {
    document.warnings.push_back(fmt::format("only the first of {} layers is read", n_layers));
  }
  cursor.seek(kHeaderSize);
  const double ny = cursor.take<std::uint32_t>();
  const double nx = cursor.take<std::uint32_t>();
  check_size(contents, nx, ny, cursor.left() / sizeof(float));
  const Raster raster{
      .sample = Sample::f32, .nx = static_cast<Index>(nx), .ny = static_cast<Index>(ny)};
  const auto load = [contents, data = cursor.take(byte_size(raster)), raster] {
    return decode(contents, data, raster, holes_where([](double z) { return z == kMissing; }));
  };
  document.layers.push_back({.name = "height",
                             .unit = "um",
                             .nx = raster.nx,
                             .ny = raster.ny,
                             .pixel_x = dx,
                             .pixel_y = dy,
                             .said_x = fmt::format("{:g} um per column", dx * 1e6),
                             .said_y = fmt::format("{:g} um per row", dy * 1e6),
                             .load = load});
  return document;
}

}  // namespace tabor::scan::format
