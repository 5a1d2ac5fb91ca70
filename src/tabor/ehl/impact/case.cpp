#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tabor/core/error.hpp"
#include "tabor/core/text.hpp"
#include "tabor/core/units.hpp"
#include "tabor/ehl/case.hpp"
#include "tabor/ehl/impact/measures.hpp"
#include "tabor/ehl/program.hpp"
#include "tabor/io/columns.hpp"
#include "tabor/reference/impact.hpp"

namespace tabor::ehl {

namespace {

constexpr double kGravity = 9.81;  // [m/s^2]
constexpr std::size_t kUsualProfiles = 60;

ImpactStart read_start(const io::Config& config) {
  const std::string word = text_or(config, "impact.start", "rigid");
  if (word != "rigid" && word != "full") {
    throw InputError(config.place("impact.start"), "'" + word + "'",
                     "rigid or full" + suggestion(word, {"rigid", "full"}), "");
  }
  return word == "rigid" ? ImpactStart::rigid : ImpactStart::full;
}

ImpactProblem read_problem(const io::Config& config) {
  ImpactProblem problem;
  problem.radius = positive_quantity(config, "ball.radius", dimension::length);
  problem.mass = positive_quantity(config, "ball.mass", dimension::mass);
  problem.speed = positive_quantity(config, "ball.speed", dimension::speed);
  problem.effective_modulus = read_effective_modulus(config);
  problem.lubricant = read_lubricant(config, "roelands");
  problem.layer = positive_quantity(config, "lubricant.layer", dimension::length);
  problem.gravity = flag_or(config, "impact.gravity", false) ? kGravity : 0;
  problem.start = read_start(config);
  problem.domain_radius = positive_quantity_or(config, "grid.domain", dimension::length, 0);
  problem.time_step = positive_quantity_or(config, "grid.time_step", dimension::time, 0);
  if (config.has("grid.nodes")) problem.nodes = config.integer("grid.nodes");
  if (config.has("impact.profiles")) {
    problem.profile_times = config.quantities("impact.profiles", dimension::time);
    std::sort(problem.profile_times.begin(), problem.profile_times.end());
  }
  problem.keeps_all_profiles = problem.profile_times.empty();
  return problem;
}

std::string_view name_of(ImpactEnd end) {
  switch (end) {
    case ImpactEnd::rebound:
      return "rebound";
    case ImpactEnd::sticks:
      return "sticks";
    case ImpactEnd::unfinished:
      break;
  }
  return "not converged";
}

io::Json groups_json(const ImpactGroups& groups) {
  return {{"H00", io::number(groups.layer)},     {"V0", io::number(groups.speed)},
          {"M", io::number(groups.mass)},        {"G", io::number(groups.material)},
          {"W", io::number(groups.force)},       {"Pcl", io::number(groups.primary_pressure)},
          {"Hmin", io::number(groups.min_film)}, {"dT_over_Tr", io::number(groups.delay)}};
}

io::Json dry_json(const reference::DryImpact& dry) {
  return {{"impact_time_s", dry.contact_time},
          {"max_force_N", dry.max_force},
          {"max_deformation_m", dry.max_approach},
          {"max_pressure_Pa", dry.max_pressure}};
}

io::Json scalars_of(const ImpactProblem& problem, const ImpactResult& result,
                    const reference::DryImpact& dry) {
  return {{"end", name_of(result.end)},
          {"impact_time_s", io::number(result.impact_time)},
          {"time_max_force_s", io::number(result.time_max_force)},
          {"max_force_N", io::number(result.max_force)},
          {"min_film_m", io::number(result.min_film)},
          {"time_min_film_s", io::number(result.time_min_film)},
          {"turning_time_s", io::number(result.turning_time)},
          {"rebound_speed_m_per_s", io::number(result.rebound_speed)},
          {"restitution", io::number(result.restitution)},
          {"max_deformation_m", io::number(result.max_deformation)},
          {"primary_center_pressure_Pa", io::number(result.primary_pressure)},
          {"time_primary_center_pressure_s", io::number(result.time_primary_pressure)},
          {"cavitation_time_s", io::number(result.cavitation_time)},
          {"phase_shift_s", io::number(result.time_min_film - result.time_max_force)},
          {"groups", groups_json(groups_of(problem, result))},
          {"dry", dry_json(dry)},
          {"full_start_time_s", io::number(result.full_start_time)},
          {"domain_m", io::number(result.domain_radius)},
          {"time_step_s", result.time_step},
          {"nodes", problem.nodes},
          {"n_steps", result.n_steps},
          {"n_cut_steps", result.n_cut_steps},
          {"newton_iterations", result.count.newton_iterations},
          {"n_factorizations", result.count.n_factorizations},
          {"converged", result.convergence.converged()},
          {"status", name_of(result.convergence.status)}};
}

std::string with_time(double value, const std::string& unit, double time) {
  return std::isnan(value) ? "-" : fmt::format("{} at {}", si(value, unit), si(time, "s"));
}

Facts facts_of(const ImpactProblem& problem, const ImpactResult& result,
               const reference::DryImpact& dry) {
  Facts facts;
  facts.push_back({"ball", fmt::format("{} radius, {}, {}", si(problem.radius, "m"),
                                       si(problem.mass * 1e3, "g"), si(problem.speed, "m/s"))});
  facts.push_back({"layer", si(problem.layer, "m")});
  facts.push_back(
      {"domain", fmt::format("{} radius, {} nodes, {} steps", si(result.domain_radius, "m"),
                             problem.nodes, result.n_steps)});
  facts.push_back({"end", result.reason.empty()
                              ? std::string(name_of(result.end))
                              : fmt::format("{}: {}", name_of(result.end), result.reason)});
  facts.push_back({"impact time", si(result.impact_time, "s")});
  facts.push_back({"largest force", with_time(result.max_force, "N", result.time_max_force)});
  facts.push_back({"smallest film", with_time(result.min_film, "m", result.time_min_film)});
  facts.push_back({"turning point", si(result.turning_time, "s")});
  facts.push_back({"first pressure peak",
                   with_time(result.primary_pressure, "Pa", result.time_primary_pressure)});
  facts.push_back({"largest deformation", si(result.max_deformation, "m")});
  facts.push_back({"cavitation from", si(result.cavitation_time, "s")});
  facts.push_back({"rebound", fmt::format("{}, restitution {}", si(result.rebound_speed, "m/s"),
                                          plain(result.restitution))});
  facts.push_back({"dry impact", fmt::format("{}, {}, {} deep, {}", si(dry.contact_time, "s"),
                                             si(dry.max_force, "N"), si(dry.max_approach, "m"),
                                             si(dry.max_pressure, "Pa"))});
  return facts;
}

using Instant = ImpactInstant;

const Columns<Instant>& history_columns() {
  static const Columns<Instant> all{
      {"time", "s", "time since the ball touched the layer", &Instant::time},
      {"force", "N", "force on the ball", &Instant::force},
      {"speed", "m/s", "speed of the ball, negative towards the flat", &Instant::speed},
      {"separation", "m", "separation of the undeformed bodies", &Instant::separation},
      {"central_film", "m", "film thickness in the centre", &Instant::central_film},
      {"min_film", "m", "smallest film thickness", &Instant::min_film},
      {"deformation", "m", "elastic deformation in the centre", &Instant::deformation},
      {"central_pressure", "Pa", "pressure in the centre", &Instant::central_pressure},
      {"max_pressure", "Pa", "largest pressure", &Instant::max_pressure},
      {"film_radius", "m", "radius of the film under pressure", &Instant::film_radius}};
  return all;
}

/// All of the profiles that were asked for, else some at about equal times.
std::vector<const ImpactProfile*> chosen_profiles(const ImpactProblem& problem,
                                                  const ImpactResult& result) {
  std::vector<const ImpactProfile*> chosen;
  if (result.profiles.empty()) return chosen;
  const double first = result.profiles.front().time;
  const double last = result.profiles.back().time;
  for (const ImpactProfile& profile : result.profiles) {
    const double due = first + (last - first) * static_cast<double>(chosen.size()) /
                                   static_cast<double>(kUsualProfiles);
    if (!problem.keeps_all_profiles || profile.time >= due) chosen.push_back(&profile);
  }
  return chosen;
}

void write_profiles(io::Hdf5Writer& writer, const ImpactProblem& problem,
                    const ImpactResult& result) {
  const std::vector<const ImpactProfile*> profiles = chosen_profiles(problem, result);
  if (profiles.empty()) return;
  const Index n = result.radius.size();
  const auto n_times = static_cast<Index>(profiles.size());
  Field pressure(n_times, n);
  Field film(n_times, n);
  std::vector<double> times;
  for (Index i = 0; i < n_times; ++i) {
    const ImpactProfile& profile = *profiles[static_cast<std::size_t>(i)];
    pressure.row(i) = profile.pressure.transpose();
    film.row(i) = profile.film.transpose();
    times.push_back(profile.time);
  }
  writer.group("/profiles");
  writer.write("/profiles/time", times);
  writer.describe("/profiles/time", "s", "time of the rows");
  writer.write("/profiles/radius",
               std::vector<double>(result.radius.data(), result.radius.data() + n));
  writer.describe("/profiles/radius", "m", "radius of the columns");
  writer.write("/profiles/pressure", pressure);
  writer.describe("/profiles/pressure", "Pa", "pressure");
  writer.write("/profiles/film", film);
  writer.describe("/profiles/film", "m", "film thickness");
}

CaseResult solve(const io::Config& config, const CaseSetting& setting) {
  const ImpactProblem problem = read_problem(config);
  ImpactResult result = solve_impact(problem, setting.observer);
  throw_if_stopped(result.convergence);
  const reference::DryImpact dry = reference::hertz_impact(
      problem.radius, problem.effective_modulus, problem.mass, problem.speed);
  CaseResult answer;
  answer.scalars = scalars_of(problem, result, dry);
  answer.facts = {facts_of(problem, result, dry)};
  answer.converged = result.convergence.converged();
  answer.warnings = result.warnings;
  if (!result.reason.empty()) answer.warnings.push_back(result.reason);
  answer.write = [problem, dry, result = std::move(result)](io::Hdf5Writer& writer) {
    io::write_curves(writer, "/history", history_columns(), result.history);
    writer.nxdata("/history", "force", {"time"});
    writer.attribute("/", "default", "history");
    write_profiles(writer, problem, result);
    writer.group("/dry");
    io::write_members(writer, "/dry", dry_json(dry));
    // The dry ball touches the flat where the layer would end.
    writer.attribute("/dry", "begin_s", problem.layer / problem.speed);
  };
  return answer;
}

/// By how much the peak of `tabor ehl impact` grows: matrices of all rings.
std::size_t memory_of(const io::Config& config) {
  const auto n = static_cast<std::size_t>(integer_or(config, "grid.nodes", ImpactProblem{}.nodes));
  return 6 * sizeof(double) * n * n;
}

CaseKeys impact_keys() {
  const CaseKeys ball = {{"ball.radius", "m", kRequired, "R, radius of the ball"},
                         {"ball.mass", "kg", kRequired, "m, its mass"},
                         {"ball.speed", "m/s", kRequired, "its speed of approach"}};
  const CaseKeys own = {
      {"lubricant.layer", "m", kRequired, "h00, thickness of the liquid on the flat"},
      {"impact.gravity", "", "false", "true or false"},
      {"impact.start", "", "rigid",
       "rigid: bodies are rigid until a contact under the force would be deformed by 1 % of the "
       "film; full: all equations from the first touch"},
      {"impact.profiles", "s", "about 60 instants", "list of times of the profiles in OUT.h5"},
      {"grid.nodes", "", fmt::format("{}", ImpactProblem{}.nodes), "along the radius"},
      {"grid.domain", "m", "as far as the ball is wet after the rigid stage",
       "r_max, how much of the wet disc is computed; decides the rebound"},
      {"grid.time_step", "s", "dry contact time over 400", "nominal step"}};
  return joined(ball, {solids_keys(), lubricant_keys("roelands"), own});
}

}  // namespace

Program impact_program() {
  return {.name = "impact",
          .summary = "a ball falls on a flat covered with a layer of liquid and rebounds",
          .keys = impact_keys(),
          .example = {{"ball.radius", "\"10 mm\""},
                      {"ball.mass", "\"32.5 g\""},
                      {"ball.speed", "\"0.2 m/s\""},
                      {"solids.e_prime", "\"230 GPa\""},
                      {"lubricant.viscosity", "\"0.1 Pa s\""},
                      {"lubricant.pressure_viscosity", "\"1.522e-8 1/Pa\""},
                      {"lubricant.density_law", "\"dowson-higginson\""},
                      {"lubricant.layer", "\"50 um\""}},
          .columns = {{"max_force_N", "force", "N"},
                      {"min_film_m", "smallest film", "m"},
                      {"max_deformation_m", "deformation", "m"},
                      {"primary_center_pressure_Pa", "pressure peak", "Pa"},
                      {"impact_time_s", "impact time", "s"},
                      {"restitution", "restitution", ""}},
          .studies = {{"grid", "grid.nodes", "nodes", "", {0.5, 1, 2}},
                      {"domain", "grid.domain", "domain_m", "m", {0.9, 1, 1.1, 1.2}, false},
                      {"time-step", "grid.time_step", "time_step_s", "s", {2, 1, 0.5}}},
          .methods = {"larsson1994", "larsson1995", "johnson1985"},
          .solve = solve,
          .memory = memory_of};
}

}  // namespace tabor::ehl
