#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "tabor/cases/ehl/program.hpp"
#include "tabor/cases/ehl/squeeze_parameters.hpp"
#include "tabor/core/text.hpp"
#include "tabor/core/units.hpp"
#include "tabor/io/columns.hpp"

namespace tabor::ehl {

namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// What a user is told of a squeezed film.
struct SqueezeRecord {
  SqueezeMeasures measures;
  std::size_t n_steps = 0;
};

const Columns<SqueezeMeasures>& measure_columns() {
  using One = SqueezeMeasures;
  static const Columns<One> all{
      {"max_force_N_per_m", "N/m", "largest force", &One::max_force, kInTable},
      {"min_film_m", "m", "smallest film", &One::min_film, kInTable},
      {"time_max_force_s", "s", "time of the largest force", &One::time_max_force, kInTable},
      {"time_min_film_s", "s", "time of the smallest film", &One::time_min_film, kAlone},
      {"turning_time_s", "s", "roller turns", &One::turning_time, kInTable},
      {"lag_s", "s", "film lags", &One::lag, kInTable},
      {"gap_closing_at_turning", "", "gap still closing at the turn",
       [](const One& one) {
         return std::isnan(one.turning_time) ? Cell(kNone) : Cell(one.gap_closing_at_turning);
       },
       kAlone},
      {"converged", "", "converged", [](const One& one) { return one.convergence.converged(); },
       kAlone},
      {"status", "", "status", [](const One& one) { return name_of(one.convergence.status); },
       kAlone}};
  return all;
}

const Columns<SqueezeRecord>& squeeze_columns() {
  using Record = SqueezeRecord;
  static const Columns<Record> all =
      joined(within(measure_columns(), &Record::measures),
             Columns<Record>{{"n_steps", "", "time steps", &Record::n_steps, kAlone}});
  return all;
}

Facts facts_of(const SqueezeResult& result) {
  Facts facts;
  facts.push_back({"largest force", fmt::format("{} at {}", si(result.max_force, "N/m"),
                                                si(result.time_max_force, "s"))});
  facts.push_back({"smallest film", fmt::format("{} at {}", si(result.min_film, "m"),
                                                si(result.time_min_film, "s"))});
  facts.push_back({"film behind force", si(result.lag, "s")});
  facts.push_back({"roller turns", si(result.turning_time, "s")});
  facts.push_back({"gap still closing at the turn",
                   std::isnan(result.turning_time) ? "-" : yes_no(result.gap_closing_at_turning)});
  facts.push_back({"end", result.reason});
  return facts;
}

/// `code`: of the reason for an end without a turning.
CaseResult answer_of(const SqueezeResult& result, const char* code) {
  CaseResult answer;
  answer.numbers = cells_of(
      squeeze_columns(), SqueezeRecord{.measures = result, .n_steps = result.history.size() - 1});
  answer.facts = {facts_of(result)};
  answer.status = status_of(result.convergence);
  answer.warnings = result.warnings;
  if (!result.reason.empty()) answer.warnings.push_back({code, result.reason});
  return answer;
}

using Instant = SqueezeInstant;

const Columns<Instant>& history_columns() {
  static const Columns<Instant> all{
      {"time", "s", "time since the roller touched the layer", &Instant::time},
      {"force", "N/m", "force per width", &Instant::force},
      {"min_film", "m", "smallest film thickness", &Instant::film},
      {"film_speed", "m/s", "rate of the film", &Instant::film_speed},
      {"roller", "m", "place of the roller", &Instant::roller},
      {"speed", "m/s", "speed of the roller", &Instant::roller_speed}};
  return all;
}

/// Takes away what a film that closed on the way never came to.
void void_what_follows(bool has_max_force, SqueezeResult& result) {
  result.min_film = result.time_min_film = result.turning_time = result.lag = kNone;
  if (!has_max_force) result.max_force = result.time_max_force = kNone;
}

/// In closed form.
CaseResult solve_linear(const LinearSqueeze& linear, double layer) {
  SqueezeResult result;
  result.time_max_force = linear.time_max_force();
  result.max_force = linear.force(result.time_max_force);
  result.time_min_film = result.turning_time = linear.time_max_displacement();
  result.min_film = layer - linear.displacement(result.time_min_film);
  result.lag = result.time_min_film - result.time_max_force;
  result.convergence = exact();
  if (result.min_film <= 0) {
    result.reason =
        "The film would close, and the equations end there. Try more damping, more stiffness or a "
        "thicker layer";
    void_what_follows(layer - linear.displacement(result.time_max_force) > 0, result);
  }
  result.history.resize(1);
  return answer_of(result, "lost-film");
}

void check_squeeze(const io::Config& config) {
  const SqueezeSettings settings = read_squeeze_settings(config);
  if (settings.model == SqueezeModel::linear) {
    linear_squeeze(settings, config);
  } else {
    squeeze_problem(settings, config);
  }
}

CaseResult solve(const io::Config& config, const CaseSetting& setting) {
  const SqueezeSettings settings = read_squeeze_settings(config);
  if (settings.model == SqueezeModel::linear) {
    return solve_linear(linear_squeeze(settings, config), settings.layer);
  }
  SqueezeResult result = solve_squeeze(squeeze_problem(settings, config), setting.observer);
  throw_if_stopped(result.convergence);
  CaseResult answer = answer_of(result, result.convergence.converged() ? "no-rebound" : "no-film");
  answer.write = [result = std::move(result)](io::Hdf5Writer& writer) {
    io::write_curves(writer, "/history", history_columns(), result.history);
    writer.nxdata("/history", "force", {"time"});
    writer.attribute("/", "default", "history");
  };
  return answer;
}

}  // namespace

Program squeeze_program() {
  return {.name = "squeeze",
          .summary = "a roller closes on a sliding flat under a layer of liquid",
          .keys = heads_of(squeeze_parameters()),
          .example = {{"roller.mass_per_length", "\"30.2 kg/m\""},
                      {"roller.effective_radius", "\"9.2 mm\""},
                      {"roller.spring", "\"2.2e10 N/m^2\""},
                      {"roller.speed", "\"0.25 m/s\""},
                      {"lubricant.viscosity", "\"0.5 Pa s\""},
                      {"lubricant.pressure_viscosity", "\"1.5e-8 1/Pa\""},
                      {"lubricant.layer", "\"0.4 mm\""},
                      {"motion.sliding_speed", "\"5 m/s\""}},
          .columns = heads_of(squeeze_columns()),
          .studies = {},
          .methods = {"larsson1994"},
          .solve = solve,
          .check = [](const io::Config& config) { check_squeeze(config); }};
}

}  // namespace tabor::ehl
