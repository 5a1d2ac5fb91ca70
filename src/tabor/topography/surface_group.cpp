#include "tabor/topography/surface_group.hpp"

#include <cstdint>

#include "tabor/core/advice.hpp"
#include "tabor/topography/edges.hpp"

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
  std::vector<std::string> doubts, codes;
  for (const Warning& warning : surface.warnings) {
    doubts.push_back(without_advice(warning.text));
    codes.push_back(warning.code);
  }
  writer.attribute("/surface", "doubts", doubts);
  writer.attribute("/surface", "doubt_codes", codes);
  writer.attribute("/surface", "periodic", surface.periodic ? 1 : 0);
  if (surface.edges) writer.attribute("/surface", "edges", std::string(kEdges.of(*surface.edges)));
  if (surface.tiles > 1) writer.attribute("/surface", "tiles", surface.tiles);
  writer.attribute("/surface", "pixel_x_m", surface.grid.dx());
  writer.attribute("/surface", "pixel_y_m", surface.grid.dy());
}

}  // namespace tabor::topography
