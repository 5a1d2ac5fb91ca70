#include "tabor/cases/ehl/wear_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "tabor/cases/ehl/line_parameters.hpp"
#include "tabor/core/units.hpp"
#include "tabor/io/columns.hpp"

namespace tabor::ehl {

namespace {

using Instant = WearInstant;
const Columns<Instant>& history_columns() {
  static const Columns<Instant> all{
      {"time", "s", "time", &Instant::time},
      {"distance", "m", "distance slid", &Instant::distance},
      {"mean_depth", "m", "wear depth, mean over the track", &Instant::mean_depth},
      {"max_depth", "m", "largest wear depth", &Instant::max_depth},
      {"sliding_speed", "m/s", "sliding speed", &Instant::sliding_speed},
      {"min_film", "m", "smallest film thickness", &Instant::min_film},
      {"max_pressure", "Pa", "largest pressure", &Instant::max_pressure},
      {"friction", "1", "friction coefficient", &Instant::friction_coefficient}};
  return all;
}

/// [m], in all the time.
double thinnest_of(const WearResult& wear) {
  double thinnest = wear.history.front().min_film;
  for (const WearInstant& at : wear.history) thinnest = std::min(thinnest, at.min_film);
  return thinnest;
}

}  // namespace

WearRecord wear_record(const io::Config& config, const WearResult& wear) {
  WearRecord record{.last = wear.history.back(),
                    .thinnest_film = thinnest_of(wear),
                    .worn_area = wear.worn_area,
                    .mass = {},
                    .time_step = wear.time_step,
                    .n_steps = wear.history.size() - 1,
                    .convergence = wear.convergence};
  const WearSettings settings = read_line_settings(config).wear;
  if (settings.density && settings.width) {
    record.mass = wear.worn_area * *settings.density * *settings.width;
  }
  return record;
}

void write_wear(io::Hdf5Writer& writer, const WearResult& wear) {
  io::write_curves(writer, "/wear", history_columns(), wear.history);
  const auto size = wear.track.size();
  writer.write("/wear/track", std::vector<double>(wear.track.data(), wear.track.data() + size));
  writer.describe("/wear/track", "m", "place along the track");
  writer.write("/wear/depth", std::vector<double>(wear.depth.data(), wear.depth.data() + size));
  writer.describe("/wear/depth", "m", "wear depth along the track at the end");
}

}  // namespace tabor::ehl
