// VTI, VTK's ImageData, for ParaView: maps as point data at the pixel centres.
#include <fmt/format.h>

#include "tabor/io/files/atomic_file.hpp"
#include "tabor/scan/formats/bytes.hpp"
#include "tabor/scan/formats/readers.hpp"

namespace tabor::scan::format {
namespace {

bool is_single(const NamedMap& map) { return map.precision == io::Precision::float32; }

std::uint64_t size_of(const NamedMap& map, const Grid& grid) {
  return static_cast<std::uint64_t>(grid.size()) *
         (is_single(map) ? sizeof(float) : sizeof(double));
}

/// One DataArray; ParaView shows its unit beside the name.
std::string array_of(const NamedMap& map, std::uint64_t offset) {
  return fmt::format(
      "        <DataArray type=\"{}\" Name=\"{}\" format=\"appended\" offset=\"{}\">\n"
      "          <InformationKey name=\"UNITS_LABEL\" location=\"vtkDataArray\">{}"
      "</InformationKey>\n        </DataArray>\n",
      is_single(map) ? "Float32" : "Float64", map.name, offset, map.unit);
}

std::string header_of(const MapSet& set) {
  const Grid& grid = set.grid;
  std::string text = fmt::format(
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"ImageData\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\">\n"
      "  <ImageData WholeExtent=\"{0}\" Origin=\"{1} {2} 0\" Spacing=\"{3} {4} 1\">\n"
      "    <Piece Extent=\"{0}\">\n      <PointData Scalars=\"{5}\">\n",
      fmt::format("0 {} 0 {} 0 0", grid.nx - 1, grid.ny - 1), set.left + grid.dx() / 2,
      set.top + grid.dy() / 2, grid.dx(), grid.dy(), set.maps.front().name);
  std::uint64_t offset = 0;
  for (const NamedMap& map : set.maps) {
    text += array_of(map, offset);
    offset += sizeof(std::uint64_t) + size_of(map, grid);
  }
  return text +
         "      </PointData>\n    </Piece>\n  </ImageData>\n  <AppendedData encoding=\"raw\">\n_";
}

std::string bytes_of(const NamedMap& map, const Grid& grid) {
  std::string bytes;
  put(bytes, size_of(map, grid));
  // VTK's y axis points up, the rows of a scan run down: they are mirrored about the map's middle.
  const Field rows = map.load().colwise().reverse();
  is_single(map) ? put_field_f32(bytes, rows) : put_field(bytes, rows);
  return bytes;
}

}  // namespace

void write_vti_maps(const MapSet& maps, const std::filesystem::path& file) {
  io::write_file(file, [&](const io::Append& append) {
    append(header_of(maps));
    for (const NamedMap& map : maps.maps) append(bytes_of(map, maps.grid));
    append("\n  </AppendedData>\n</VTKFile>\n");
  });
}

void write_vti(const topography::Topography& topography, const std::filesystem::path& file) {
  write_vti_maps(as_maps(topography, "height"), file);
}

}  // namespace tabor::scan::format
