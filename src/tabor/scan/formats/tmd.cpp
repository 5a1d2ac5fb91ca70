// TMD, TrueMap data files version 2; every length in millimetres.
#include <fmt/format.h>

#include <fmt/format.h>

#include "tabor/scan/formats/bytes.hpp"
#include "tabor/scan/formats/readers.hpp"

namespace tabor::scan::format {
namespace {

constexpr std::string_view kMagic{"Binary TrueMap Data File v2.0\r\n\0", 32};

}  // namespace

Match identify_tmd(std::string_view head) {
  return head.starts_with(kMagic) ? Match::yes : Match::no;
}

Document open_tmd(const Contents& contents) {
  Cursor cursor(contents);
  cursor.skip(kMagic.size());
  Document document{.format = "tmd"};
  document.metadata["Comment"] = cursor.take_terminated();
  const double nx = cursor.take<std::uint32_t>();
  const double ny = cursor.take<std::uint32_t>();
  const double lx = cursor.take<float>() * 1e-3;
  const double ly = cursor.take<float>() * 1e-3;
  cursor.skip(2 * sizeof(float));  // origin
  check_size(contents, nx, ny, cursor.left() / sizeof(float));
  const Raster raster{
      .sample = Sample::f32, .nx = static_cast<Index>(nx), .ny = static_cast<Index>(ny)};
  const auto load = [contents, data = cursor.take(byte_size(raster)), raster] {
    return decode(contents, data, raster);
  };
  warn_of_surplus(cursor, document);
  document.layers.push_back({.name = "height",
                             .unit = "mm",
                             .nx = raster.nx,
                             .ny = raster.ny,
                             .pixel_x = lx / nx,
                             .pixel_y = ly / ny,
                             .said_x = fmt::format("a length of {:g} mm", lx * 1e3),
                             .said_y = fmt::format("a width of {:g} mm", ly * 1e3),
                             .load = load});
  return document;
}

}  // namespace tabor::scan::format
