#include "tabor/ehl/point/case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "tabor/core/error.hpp"
#include "tabor/core/units.hpp"
#include "tabor/ehl/case.hpp"
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
  const double duration = positive_quantity(config, "motion.duration", dimension::time);
  const double fastest = std::max(std::abs(speed), problem.contact.entrainment_speed);
  const double longest = positive_quantity_or(config, "grid.time_step", dimension::time,
                                              point_grid(problem.contact).dx() / fastest);
  const double steps = std::ceil(duration / longest);
  if (!(steps <= kMostSteps)) {
    throw InputError(config.place("motion.duration"), fmt::format("{:.0f} time steps", steps),
                     fmt::format("{:.0f} or less", kMostSteps),
                     "a shorter duration or a longer grid.time_step");
  }
  problem.steps = static_cast<int>(steps);
  problem.time_step = duration / steps;
}

/// The film under a rough surface that moves with its body, at u_m - u_s/2.
struct PointPassage {
  PointProblem at_end;  ///< with the roughness where it was last
  double speed = 0;     ///< of the roughness [m/s]
  TransientPointResult film;
  RoughnessNotes notes = {};
};

PointPassage solve_passage(const io::Config& config, const CaseSetting& setting) {
  TransientPointProblem problem{.contact = read_point(config), .roughness = {}};
  if (config.has("solids.plastic_pressure")) {
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
  PointPassage passage{.at_end = problem.contact,
                       .speed = speed,
                       .film = solve_point_transient(problem, setting.observer),
                       .notes = roughness.notes};
  throw_if_stopped(passage.film.convergence);
  passage.at_end.roughness = problem.roughness(passage.film.history.back().time);
  return passage;
}

/// What happened on the way: scalars under "history", lines of text, curves in /history.
void add_history(const PointPassage& passage, CaseResult& answer) {
  const std::vector<Moment>& history = passage.film.history;
  const auto least =
      std::min_element(history.begin(), history.end(),
                       [](const Moment& a, const Moment& b) { return a.min_film < b.min_film; });
  const auto most = std::max_element(
      history.begin(), history.end(),
      [](const Moment& a, const Moment& b) { return a.max_pressure < b.max_pressure; });
  const double end = history.back().time;
  answer.scalars["history"] = {{"steps", history.size() - 1},
                               {"end_s", end},
                               {"roughness_speed_m_per_s", passage.speed},
                               {"min_film_m", io::number(least->min_film)},
                               {"time_min_film_s", least->time},
                               {"max_pressure_Pa", io::number(most->max_pressure)},
                               {"time_max_pressure_s", most->time}};
  Facts facts;
  facts.push_back(
      {"all this at", fmt::format("{}, after {} steps", si(end, "s"), history.size() - 1)});
  facts.push_back({"on the way", fmt::format("film down to {} at {}, pressure up to {} at {}",
                                             si(least->min_film, "m"), si(least->time, "s"),
                                             si(most->max_pressure, "Pa"), si(most->time, "s"))});
  facts.push_back({"speed of roughness", si(passage.speed, "m/s")});
  answer.facts.push_back(std::move(facts));
  answer.converged = passage.film.convergence.converged();
  if (!answer.converged) {
    answer.warnings.push_back(fmt::format(
        "no film was found after {}: where solids would touch, the passage ends", si(end, "s")));
  }
  answer.write = [fields = answer.write, history](io::Hdf5Writer& writer) {
    fields(writer);
    io::write_curves(writer, "/history", history_columns(), history);
  };
}

}  // namespace

bool has_passage(const io::Config& config) { return config.has("motion.duration"); }

CaseResult passage_result(const io::Config& config, const CaseSetting& setting) {
  const PointPassage passage = solve_passage(config, setting);
  CaseResult answer =
      point_result(config, passage.at_end, passage.film.last, setting, passage.notes);
  add_history(passage, answer);
  return answer;
}

}  // namespace tabor::ehl
