// VTI, VTK's ImageData, for ParaView: heights as point data at the pixel centres.
#include <fmt/format.h>

#include "tabor/io/atomic_file.hpp"
#include "tabor/scan/formats/bytes.hpp"
#include "tabor/scan/formats/readers.hpp"

namespace tabor::scan::format {

void write_vti(const topography::Topography& topography, const std::filesystem::path& file) {
  const Grid& grid = topography.grid;
  const std::string extent = fmt::format("0 {} 0 {} 0 0", grid.nx - 1, grid.ny - 1);
  std::string bytes = fmt::format(
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"ImageData\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\">\n"
      "  <ImageData WholeExtent=\"{0}\" Origin=\"{1} {2} 0\" Spacing=\"{3} {4} 1\">\n"
      "    <Piece Extent=\"{0}\">\n      <PointData Scalars=\"height\">\n"
      "        <DataArray type=\"Float64\" Name=\"height\" format=\"appended\" offset=\"0\"/>\n"
      "      </PointData>\n    </Piece>\n  </ImageData>\n  <AppendedData encoding=\"raw\">\n_",
      extent, grid.dx() / 2, grid.dy() / 2, grid.dx(), grid.dy());
  put(bytes, static_cast<std::uint64_t>(topography.height.size()) * sizeof(double));
  // VTK's y axis points up, the rows of a scan run down.
  put_field(bytes, topography.height.colwise().reverse());
  bytes += "\n  </AppendedData>\n</VTKFile>\n";
  io::write_file(file, std::string_view(bytes));
}

}  // namespace tabor::scan::format
