#include "tabor/ehl/line/wear_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "tabor/core/error.hpp"
#include "tabor/core/units.hpp"
#include "tabor/ehl/case.hpp"
#include "tabor/io/columns.hpp"

namespace tabor::ehl {

namespace {

constexpr std::int64_t kUsualSteps = 600;  // per cycle

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

CaseKeys wear_keys() {
  return {
      {"wear.coefficient", "m^2/N", "no wear", "kw, worn volume over load and distance"},
      {"wear.track_length", "m", "required, unless stroke is given",
       "of a track that runs with the sliding speed"},
      {"wear.stroke", "m", "runs one way",
       "the track goes to and fro as a sine with the speeds of [motion] in its middle"},
      {"wear.steps", "", fmt::format("{}", kUsualSteps), "of time per cycle"},
      {"wear.cycles", "", "1", "computed cycles"},
      {"wear.cycles_each", "", "1", "what each computed cycle stands for"},
      {"wear.density", "kg/m^3", "no mass", "of the worn body; with width it gives the worn mass"},
      {"wear.width", "m", "no mass", "of the track"},
      {"wear.wave_amplitude", "m", "smooth", "of waves of the unworn track"},
      {"wear.waves", "", "required beside wave_amplitude", "a whole number of them"}};
}

WearProblem read_wear(const io::Config& config, const LineProblem& contact) {
  if (contact.roughness.size() > 0) {
    throw InputError(config.place("wear.coefficient"), "beside a roughness that stands still",
                     "one of the two", "wear.wave_amplitude makes the track rough");
  }
  WearProblem problem;
  problem.contact = contact;
  problem.wear_coefficient = positive_quantity(config, "wear.coefficient", dimension::per_pressure);
  problem.stroke = positive_quantity_or(config, "wear.stroke", dimension::length, 0);
  if (!config.has("wear.stroke") || config.has("wear.track_length")) {
    problem.track_length = positive_quantity(config, "wear.track_length", dimension::length);
  }
  problem.steps_per_cycle = integer_or(config, "wear.steps", kUsualSteps);
  problem.cycles = integer_or(config, "wear.cycles", 1);
  if (config.has("wear.cycles_each")) problem.cycles_each = config.number("wear.cycles_each");
  if (config.has("wear.wave_amplitude")) {
    problem.wave_amplitude = config.quantity("wear.wave_amplitude", dimension::length);
    problem.n_waves = config.integer("wear.waves");
  }
  return problem;
}

io::Json wear_json(const io::Config& config, const WearResult& wear) {
  const WearInstant& last = wear.history.back();
  io::Json json = {{"time_s", last.time},
                   {"distance_m", last.distance},
                   {"mean_depth_m", last.mean_depth},
                   {"max_depth_m", last.max_depth},
                   {"volume_per_width_m2", wear.worn_area},
                   {"min_film_m", io::number(last.min_film)},
                   {"thinnest_film_m", io::number(thinnest_of(wear))},
                   {"friction_coefficient", io::number(last.friction_coefficient)},
                   {"time_step_s", wear.time_step},
                   {"n_steps", wear.history.size() - 1},
                   {"newton_iterations", wear.convergence.iterations},
                   {"converged", wear.convergence.converged()},
                   {"status", name_of(wear.convergence.status)}};
  if (config.has("wear.density") || config.has("wear.width")) {
    json["mass_kg"] = wear.worn_area *
                      positive_quantity(config, "wear.density", dimension::density) *
                      positive_quantity(config, "wear.width", dimension::length);
  }
  return json;
}

Facts wear_facts(const WearResult& wear) {
  const WearInstant& last = wear.history.back();
  Facts facts;
  facts.push_back({"slid", fmt::format("{} in {}", si(last.distance, "m"), si(last.time, "s"))});
  facts.push_back({"worn off", fmt::format("{} on average, {} at most", si(last.mean_depth, "m"),
                                           si(last.max_depth, "m"))});
  facts.push_back({"film then", fmt::format("{}, {} at the thinnest", si(last.min_film, "m"),
                                            si(thinnest_of(wear), "m"))});
  facts.push_back({"friction then", plain(last.friction_coefficient)});
  return facts;
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
