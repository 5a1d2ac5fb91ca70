// Writing NetCDF as SurfaceTopography reads it (IO/NC.py): classic, 64-bit offsets, metres.
#include <cmath>

#include "tabor/io/files/atomic_file.hpp"
#include "tabor/io/text/json.hpp"
#include "tabor/scan/formats/netcdf.hpp"
#include "tabor/scan/formats/readers.hpp"

namespace tabor::scan::format {
namespace {

NetcdfVariable axis(const std::string& name, Index n, double length, bool is_periodic) {
  return {.name = name,
          .dimensions = {{name, static_cast<std::uint64_t>(n)}},
          .attributes = {{"length", std::vector<double>{length}},
                         {"periodic", std::vector<double>{is_periodic ? 1.0 : 0.0}},
                         {"unit", "m"}}};
}

std::string remarks_of(const topography::Topography& topography) {
  io::Json remarks;
  remarks["name"] = writable_text(topography.channel.empty() ? "height" : topography.channel);
  if (!topography.instrument.empty()) {
    remarks["instrument"]["name"] = writable_text(topography.instrument);
  }
  if (!topography.history.empty()) remarks["history"] = topography.history;
  return io::to_text(remarks, -1);
}

/// Heights come last: only the last variable may be larger than 4 GiB.
NetcdfHeader header_of(const topography::Topography& topography) {
  const Grid& grid = topography.grid;
  NetcdfHeader header{.attributes = {{"json", remarks_of(topography)}}, .variables = {}};
  header.variables.push_back(axis("x", grid.nx, grid.lx, topography.periodic));
  auto places = header.variables[0].dimensions;
  if (!is_line(grid)) {
    header.variables.push_back(axis("y", grid.ny, grid.ly, topography.periodic));
    places.push_back(header.variables[1].dimensions[0]);
  }
  if (topography::count_holes(topography) > 0) {
    header.variables.push_back({.name = "mask", .dimensions = places, .sample = Sample::i8});
  }
  header.variables.push_back(
      {.name = "heights", .dimensions = places, .attributes = {{"unit", "m"}}});
  return header;
}

void put_big(std::string& bytes, double value) { put(bytes, in_order(value, std::endian::big)); }

std::string positions_of(Index n, double pitch) {
  std::string bytes;
  for (Index i = 0; i < n; ++i) put_big(bytes, static_cast<double>(i) * pitch);
  return bytes;
}

/// One byte per height, 1 for a hole, padded to 4 bytes; x is the slow index.
std::string mask_of(const Field& height) {
  std::string bytes;
  for (Index x = 0; x < height.cols(); ++x) {
    for (Index y = 0; y < height.rows(); ++y) put(bytes, std::isnan(height(y, x)) ? '\1' : '\0');
  }
  constexpr std::size_t kAlignment = 4;
  bytes.resize((bytes.size() + kAlignment - 1) / kAlignment * kAlignment, '\0');
  return bytes;
}

std::string column_of(const Field& height, Index x) {
  std::string bytes;
  for (Index y = 0; y < height.rows(); ++y) put_big(bytes, height(y, x));
  return bytes;
}

}  // namespace

void append_nc(const topography::Topography& topography, const io::Append& append) {
  NetcdfHeader header = header_of(topography);
  const Grid& grid = topography.grid;
  append(netcdf_header_bytes(header));
  append(positions_of(grid.nx, grid.dx()));
  if (!is_line(grid)) append(positions_of(grid.ny, grid.dy()));
  if (header.variable("mask") != nullptr) append(mask_of(topography.height));
  for (Index x = 0; x < grid.nx; ++x) append(column_of(topography.height, x));
}

void write_nc(const topography::Topography& topography, const std::filesystem::path& file) {
  io::write_file(file, [&](const io::Append& append) { append_nc(topography, append); });
}

}  // namespace tabor::scan::format
