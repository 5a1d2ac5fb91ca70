#include "tabor/topography/surface_group.hpp"

#include <cstdint>

namespace tabor::topography {

void write_surface_group(io::Hdf5Writer& writer, const Topography& surface,
                         const std::string& source, io::Precision precision) {
  writer.group("/surface");
  writer.axes("/surface", surface.grid);
  writer.write("/surface/height", surface.height, precision);
  writer.describe("/surface/height", "m", "height, asperities up");
  writer.attach_axes("/surface/height");
  writer.write("/surface/mask", io::ByteMap(holes(surface).cast<std::uint8_t>()));
  writer.describe("/surface/mask", "1", "1 where the height is missing");
  writer.attach_axes("/surface/mask");
  writer.nxdata("/surface", "height");
  writer.attribute("/surface", "source", source);
  writer.attribute("/surface", "format", surface.format);
  writer.attribute("/surface", "instrument", surface.instrument);
  writer.attribute("/surface", "channel", surface.channel);
  writer.attribute("/surface", "treatment", surface.history);
  writer.attribute("/surface", "doubts", texts(surface.warnings));
  std::vector<std::string> codes;
  for (const Warning& warning : surface.warnings) codes.push_back(warning.code);
  writer.attribute("/surface", "doubt_codes", codes);
  writer.attribute("/surface", "periodic", surface.periodic ? 1 : 0);
  writer.attribute("/surface", "pixel_x_m", surface.grid.dx());
  writer.attribute("/surface", "pixel_y_m", surface.grid.dy());
}

}  // namespace tabor::topography
