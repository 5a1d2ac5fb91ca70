#include "tabor/cases/ehl/point_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "tabor/cases/ehl/case.hpp"
#include "tabor/cases/ehl/point_parameters.hpp"
#include "tabor/core/error.hpp"
#include "tabor/core/units.hpp"
#include "tabor/ehl/point/transient.hpp"
#include "tabor/io/columns.hpp"

namespace tabor::ehl {

namespace {

constexpr double kMostSteps = 100000;

using Moment = PointMoment;

const Columns<Moment>& history_columns() {
  static const Columns<Moment> all{
      {"time", "s", "time since the surface began to move", &Moment::time},
      {"central_film", "m", "film thickness in the centre", &Moment::central_film},
      {"min_film", "m", "smallest film thickness", &Moment::min_film},
      {"max_pressure", "Pa", "largest pressure", &Moment::max_pressure}};
  return all;
}

/// Speed of the rough body [m/s]: the slower one for a positive sliding speed.
double roughness_speed(const io::Config& config, const PointProblem& problem) {
  const double speed = problem.entrainment_speed - problem.sliding_speed / 2;
  if (std::abs(speed) > 1e-9 * problem.entrainment_speed) return speed;
  throw InputError(config.place("motion.duration"), "a rough surface at rest",
                   "motion.entrainment_speed with a motion.sliding_speed that is not twice as much",
                   "the rough body moves at the entrainment less half of the sliding speed");
}

void set_steps(const io::Config& config, double speed, TransientPointProblem& problem) {
  const PointSettings settings = read_point_settings(config);
  const double duration = required(settings.duration, config, "motion.duration");
  const double fastest = std::max(std::abs(speed), problem.contact.entrainment_speed);
  const double longest = settings.time_step.value_or(point_grid(problem.contact).dx() / fastest);
  const double steps = std::ceil(duration / longest);
  if (!(steps <= kMostSteps)) {
    throw InputError(config.place("motion.duration"), fmt::format("{:.0f} time steps", steps),
                     fmt::format("{:.0f} or less", kMostSteps),
                     "a shorter duration or a longer grid.time_step");
  }
  problem.steps = static_cast<int>(steps);
  problem.time_step = duration / steps;
}

/// A film under a rough surface that moves with its body, at u_m - u_s/2.
struct SolvedTransient {
  PointProblem at_end;  ///< with the roughness where it was last
  double speed = 0;     ///< of the roughness [m/s]
  TransientPointResult film;
  RoughnessNotes notes = {};
};

SolvedTransient solve_transient(const io::Config& config, const CaseSetting& setting) {
  TransientPointProblem problem{.contact = read_point(config), .roughness = {}};
  if (read_point_settings(config).plastic_pressure) {
    throw InputError(config.place("solids.plastic_pressure"), "beside motion.duration",
                     "one of the two", "moving solids do not touch or flow in this program");
  }
  const double speed = roughness_speed(config, problem.contact);
  set_steps(config, speed, problem);
  const double travel = speed * problem.time_step * problem.steps;
  const PointRoughness roughness = read_point_roughness(config, problem.contact, travel, setting);
  if (!roughness.heights) {
    throw InputError(config.place("motion.duration"), "a smooth surface", "a [roughness]",
                     "smooth bodies have a steady film");
  }
  roughness.heights(travel);  // a map that is too short is rejected before anything is solved
  problem.roughness = [&](double time) { return roughness.heights(speed * time); };
  SolvedTransient solved{.at_end = problem.contact,
                         .speed = speed,
                         .film = solve_point_transient(problem, setting.observer),
                         .notes = roughness.notes};
  throw_if_stopped(solved.film.convergence);
  solved.at_end.roughness = problem.roughness(solved.film.history.back().time);
  return solved;
}

/// What happened on the way.
PointHistory history_of(const SolvedTransient& solved) {
  const std::vector<Moment>& history = solved.film.history;
  const auto by = [](auto number) {
    return [number](const Moment& a, const Moment& b) { return a.*number < b.*number; };
  };
  return {.n_steps = history.size() - 1,
          .end = history.back().time,
          .roughness_speed = solved.speed,
          .thinnest = *std::min_element(history.begin(), history.end(), by(&Moment::min_film)),
          .hardest = *std::max_element(history.begin(), history.end(), by(&Moment::max_pressure))};
}

}  // namespace

bool has_transient(const io::Config& config) {
  return read_point_settings(config).duration.has_value();
}

PointOutcome transient_outcome(const io::Config& config, const CaseSetting& setting) {
  const SolvedTransient solved = solve_transient(config, setting);
  PointOutcome outcome = outcome_of(config, solved.at_end, solved.film.last, setting, solved.notes);
  outcome.record.history = history_of(solved);
  outcome.transient = solved.film.convergence;
  if (!solved.film.convergence.converged()) {
    outcome.warnings.push_back(
        {"lost-film", fmt::format("No film was found after {}. The transient ends where solids "
                                  "would touch",
                                  si(solved.film.history.back().time, "s"))});
  }
  outcome.write = [fields = outcome.write, history = solved.film.history](io::Hdf5Writer& writer) {
    fields(writer);
    io::write_curves(writer, "/history", history_columns(), history);
  };
  return outcome;
}

}  // namespace tabor::ehl
