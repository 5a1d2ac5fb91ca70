#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "tabor/core/error.hpp"
#include "tabor/core/text.hpp"
#include "tabor/core/units.hpp"
#include "tabor/ehl/case.hpp"
#include "tabor/ehl/impact/squeeze.hpp"
#include "tabor/ehl/program.hpp"
#include "tabor/io/columns.hpp"

namespace tabor::ehl {

namespace {

constexpr Dimension kMassPerLength{-1, 1, 0, 0};
constexpr Dimension kDampingPerLength{-1, 1, -1, 0};  // N s/m^2

SqueezeProblem read_problem(const io::Config& config) {
  SqueezeProblem problem;
  problem.mass = positive_quantity(config, "roller.mass_per_length", kMassPerLength);
  problem.radius = positive_quantity(config, "roller.effective_radius", dimension::length);
  problem.spring = positive_quantity(config, "roller.spring", dimension::pressure);
  problem.speed = positive_quantity(config, "roller.speed", dimension::speed);
  const std::string law = text_or(config, "lubricant.viscosity_law", "barus");
  if (law != "barus" && law != "constant") {
    throw InputError(config.place("lubricant.viscosity_law"), "'" + law + "'",
                     "barus or constant" + suggestion(law, {"barus", "constant"}),
                     "the film is known in closed form for these two only");
  }
  const material::Lubricant lubricant = read_lubricant(config, "barus");
  problem.viscosity = material::ambient_viscosity(lubricant.viscosity);
  problem.pressure_coefficient = material::pressure_coefficient(lubricant.viscosity);
  problem.layer = positive_quantity(config, "lubricant.layer", dimension::length);
  if (config.has("motion.sliding_speed")) {
    problem.sliding_speed = config.quantity("motion.sliding_speed", dimension::speed);
  }
  if (!flag_or(config, "motion.gravity", true)) problem.gravity = 0;
  problem.time_step = positive_quantity_or(config, "grid.time_step", dimension::time, 0);
  return problem;
}

io::Json scalars_of(const SqueezeResult& result) {
  return {{"max_force_N_per_m", io::number(result.max_force)},
          {"time_max_force_s", io::number(result.time_max_force)},
          {"min_film_m", io::number(result.min_film)},
          {"time_min_film_s", io::number(result.time_min_film)},
          {"turning_time_s", io::number(result.turning_time)},
          {"lag_s", io::number(result.lag)},
          {"gap_closing_at_turning", result.gap_closing_at_turning},
          {"n_steps", result.history.size() - 1},
          {"converged", result.convergence.converged()},
          {"status", name_of(result.convergence.status)}};
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
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  result.min_film = result.time_min_film = result.turning_time = result.lag = kNone;
  if (!has_max_force) result.max_force = result.time_max_force = kNone;
}

/// The film as a spring and a damper, in closed form, under the same keys.
CaseResult solve_linear(const io::Config& config) {
  LinearSqueeze linear;
  linear.mass = positive_quantity(config, "roller.mass_per_length", kMassPerLength);
  linear.stiffness = positive_quantity(config, "roller.spring", dimension::pressure);
  linear.damping = positive_quantity(config, "roller.damping", kDampingPerLength);
  linear.speed = positive_quantity(config, "roller.speed", dimension::speed);
  const double layer = positive_quantity(config, "lubricant.layer", dimension::length);
  if (linear.damping >= 2 * std::sqrt(linear.stiffness * linear.mass)) {
    throw InputError(config.place("roller.damping"), fmt::format("{} N s/m^2", linear.damping),
                     fmt::format("less than the critical damping, {:.4g} N s/m^2",
                                 2 * std::sqrt(linear.stiffness * linear.mass)),
                     "");
  }
  SqueezeResult result;
  result.time_max_force = linear.time_max_force();
  result.max_force = linear.force(result.time_max_force);
  result.time_min_film = result.turning_time = linear.time_max_displacement();
  result.min_film = layer - linear.displacement(result.time_min_film);
  result.lag = result.time_min_film - result.time_max_force;
  result.convergence = exact();
  if (result.min_film <= 0) {
    result.reason =
        "the film would close, and no equation goes on from there: more damping, more stiffness or "
        "a thicker layer";
    void_what_follows(layer - linear.displacement(result.time_max_force) > 0, result);
  }
  result.history.resize(1);
  CaseResult answer{scalars_of(result), {facts_of(result)}, true};
  if (!result.reason.empty()) answer.warnings.push_back(result.reason);
  return answer;
}

CaseResult solve(const io::Config& config, const CaseSetting& setting) {
  const std::string model = text_or(config, "squeeze.model", "hydrodynamic");
  if (model == "linear") return solve_linear(config);
  if (model != "hydrodynamic") {
    throw InputError(config.place("squeeze.model"), "'" + model + "'",
                     "hydrodynamic or linear" + suggestion(model, {"hydrodynamic", "linear"}), "");
  }
  SqueezeResult result = solve_squeeze(read_problem(config), setting.observer);
  throw_if_stopped(result.convergence);
  CaseResult answer{scalars_of(result), {facts_of(result)}, result.convergence.converged()};
  if (!result.reason.empty()) answer.warnings.push_back(result.reason);
  answer.write = [result = std::move(result)](io::Hdf5Writer& writer) {
    io::write_curves(writer, "/history", history_columns(), result.history);
    writer.nxdata("/history", "force", {"time"});
    writer.attribute("/", "default", "history");
  };
  return answer;
}

CaseKeys squeeze_keys() {
  const CaseKeys roller = {
      {"roller.mass_per_length", "kg/m", kRequired, "m, per width"},
      {"roller.effective_radius", "m", "required by hydrodynamic", "R of roller and flat together"},
      {"roller.spring", "N/m^2", kRequired, "k_e, between roller and film, per width"},
      {"roller.damping", "N s/m^2", "required by linear", "c, per width"},
      {"roller.speed", "m/s", kRequired, "of approach"}};
  const CaseKeys own = {{"lubricant.layer", "m", kRequired, "h00, where the film begins"},
                        {"motion.sliding_speed", "m/s", "0 m/s", "Vs"},
                        {"motion.gravity", "", "true", "true or false"},
                        {"grid.time_step", "s", "layer over 2000 times the speed", "nominal step"},
                        {"squeeze.model", "", "hydrodynamic",
                         "hydrodynamic, or linear: m x'' + c x' + k x = 0 in closed form"}};
  return joined(roller, {viscosity_keys("barus"), own});
}

}  // namespace

Program squeeze_program() {
  return {.name = "squeeze",
          .summary = "a roller closes on a sliding flat under a layer of liquid",
          .keys = squeeze_keys(),
          .example = {{"roller.mass_per_length", "\"30.2 kg/m\""},
                      {"roller.effective_radius", "\"9.2 mm\""},
                      {"roller.spring", "\"2.2e10 N/m^2\""},
                      {"roller.speed", "\"0.25 m/s\""},
                      {"lubricant.viscosity", "\"0.5 Pa s\""},
                      {"lubricant.pressure_viscosity", "\"1.5e-8 1/Pa\""},
                      {"lubricant.layer", "\"0.4 mm\""},
                      {"motion.sliding_speed", "\"5 m/s\""}},
          .columns = {{"max_force_N_per_m", "force", "N/m"},
                      {"min_film_m", "smallest film", "m"},
                      {"time_max_force_s", "time of force", "s"},
                      {"turning_time_s", "roller turns", "s"},
                      {"lag_s", "film lags", "s"}},
          .studies = {},
          .methods = {"larsson1994"},
          .solve = solve};
}

}  // namespace tabor::ehl
