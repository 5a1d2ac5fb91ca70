#include "tabor/cases/surface_summary.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tabor/metrology/areal/parameters.hpp"
#include "tabor/topography/edges.hpp"
#include "tabor/topography/levelling.hpp"
#include "tabor/topography/warnings.hpp"

namespace tabor::cases {

const Columns<SurfaceRecord>& surface_columns() {
  using Record = SurfaceRecord;
  static const Columns<Record> all{
      {"channel", "", "", &Record::channel},
      {"nx", "", "", member_of(&Record::grid, &Grid::nx)},
      {"ny", "", "", member_of(&Record::grid, &Grid::ny)},
      {"pixel_x_m", "m", "", [](const Record& one) { return one.grid.dx(); }},
      {"pixel_y_m", "m", "", [](const Record& one) { return one.grid.dy(); }},
      {"size_x_m", "m", "", member_of(&Record::grid, &Grid::lx)},
      {"size_y_m", "m", "", member_of(&Record::grid, &Grid::ly)},
      {"periodic", "", "", &Record::periodic},
      {"missing_pixels", "", "", &Record::missing_pixels},
      {"missing_fraction", "", "", [](const Record& one) { return one.missing_fraction(); }},
      {"height_min_m", "m", "", &Record::min},
      {"height_max_m", "m", "", &Record::max},
      {"height_rms_m", "m", "", &Record::rms},
      {"tilt_m", "m", "", &Record::tilt},
      {"height_quantum_m", "m", "", &Record::quantum}};
  return all;
}

SurfaceRecord summary_of(const topography::Topography& surface) {
  SurfaceRecord record;
  record.channel = surface.channel;
  record.grid = surface.grid;
  record.periodic = topography::repeats(surface);
  record.missing_pixels = topography::count_holes(surface);
  const Index n = surface.height.size();
  if (record.missing_pixels == n) return record;
  record.min = std::numeric_limits<double>::infinity();
  record.max = -record.min;
  for (Index i = 0; i < n; ++i) {
    const double z = surface.height.data()[i];
    if (!std::isfinite(z)) continue;
    record.min = std::min(record.min, z);
    record.max = std::max(record.max, z);
  }
  record.rms = metrology::rms_height(surface);
  if (const auto plane = topography::try_fit_form(surface.height, 1)) {
    const auto [along_x, along_y] = topography::tilt_of(*plane, surface.grid);
    record.tilt = std::hypot(along_x * surface.grid.lx, along_y * surface.grid.ly);
  }
  const double quantum = topography::height_quantum(surface.height);
  if (quantum > 0) record.quantum = quantum;
  return record;
}

}  // namespace tabor::cases
