#include "tabor/scan/maps.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "tabor/core/error.hpp"
#include "tabor/core/text.hpp"
#include "tabor/scan/formats/readers.hpp"

namespace tabor::scan {
namespace {

namespace fs = std::filesystem;

struct MapWriter {
  std::string extension;
  bool takes_several;
  void (*write)(const MapSet& maps, const fs::path& file);
};

const std::vector<MapWriter>& writers() {
  static const std::vector<MapWriter> all{
      {".vti", true, format::write_vti_maps}, {".gwy", true, format::write_gwy_maps},
      {".csv", true, format::write_csv_maps}, {".xyz", false, format::write_xyz_map},
      {".npy", false, format::write_npy_map}, {".txt", false, format::write_matrix_map}};
  return all;
}

std::vector<std::string> extensions_of_several() {
  std::vector<std::string> extensions;
  for (const MapWriter& writer : writers()) {
    if (writer.takes_several) extensions.push_back(writer.extension);
  }
  return extensions;
}

const MapWriter& writer_for(const fs::path& file) {
  const std::string extension = lower(file.extension().string());
  for (const MapWriter& writer : writers()) {
    if (writer.extension == extension) return writer;
  }
  throw InputError(file.string(), "extension '" + file.extension().string() + "'",
                   fmt::format("one of {} for maps of a result", fmt::join(map_extensions(), " ")),
                   "");
}

}  // namespace

std::vector<std::string> map_extensions() {
  std::vector<std::string> extensions;
  for (const MapWriter& writer : writers()) extensions.push_back(writer.extension);
  return extensions;
}

void write(const MapSet& maps, const fs::path& file) {
  const MapWriter& writer = writer_for(file);
  if (maps.maps.size() != 1 && !writer.takes_several) {
    throw InputError(file.string(), fmt::format("{} maps", maps.maps.size()),
                     fmt::format("one map in {}", writer.extension),
                     fmt::format("choose one map of one state, or write {}",
                                 fmt::join(extensions_of_several(), " ")));
  }
  writer.write(maps, file);
}

namespace format {

MapSet as_maps(const topography::Topography& topography, const std::string& name) {
  return {.grid = topography.grid,
          .maps = {{.name = name, .unit = "m", .load = [&] { return topography.height; }}}};
}

}  // namespace format

}  // namespace tabor::scan
