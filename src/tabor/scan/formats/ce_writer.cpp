// Writing a container of contact.engineering: one surface of one measurement in NetCDF, and its
// index twice, as SurfaceTopography does (Container/IO/CE.py): JSON is YAML, too.
#include "tabor/core/version.hpp"
#include "tabor/io/files/atomic_file.hpp"
#include "tabor/io/files/zip.hpp"
#include "tabor/io/text/json.hpp"
#include "tabor/scan/formats/bytes.hpp"
#include "tabor/scan/formats/netcdf.hpp"
#include "tabor/scan/formats/readers.hpp"

namespace tabor::scan::format {
namespace {

constexpr const char* kHeights = "topography0.nc";

io::Json index_of(const topography::Topography& topography) {
  const std::string name =
      writable_text(topography.channel.empty() ? "height" : topography.channel);
  io::Json measurement;
  measurement["name"] = name;
  measurement["datafile"]["squeezed-netcdf"] = kHeights;
  measurement["size"] = {topography.grid.lx};
  if (!is_line(topography.grid)) measurement["size"].push_back(topography.grid.ly);
  measurement["unit"] = "m";
  measurement["is_periodic"] = topography.periodic;
  measurement["has_undefined_data"] = topography::count_holes(topography) > 0;
  measurement["fill_undefined_data_mode"] = "do-not-fill";
  io::Json surface;
  const std::string source = std::filesystem::path(topography.source).filename().string();
  surface["name"] = writable_text(source.empty() ? name : source);
  surface["topographies"] = io::Json::array({measurement});
  io::Json index;
  index["versions"]["tabor"] = kVersion;
  index["surfaces"] = io::Json::array({surface});
  return index;
}

}  // namespace

void write_ce(const topography::Topography& topography, const std::filesystem::path& file) {
  std::string heights;
  append_nc(topography, [&](std::string_view piece) { heights += piece; });
  const std::string index = io::to_text(index_of(topography));
  io::write_file(
      file, std::string_view(io::zip(
                {{"index.json", index}, {"meta.yml", index}, {kHeights, std::move(heights)}})));
}

}  // namespace tabor::scan::format
