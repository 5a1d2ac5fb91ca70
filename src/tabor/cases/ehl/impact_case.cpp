#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tabor/cases/ehl/impact_parameters.hpp"
#include "tabor/cases/ehl/impact_record.hpp"
#include "tabor/cases/ehl/program.hpp"
#include "tabor/core/units.hpp"
#include "tabor/io/columns.hpp"

namespace tabor::ehl {

namespace {

constexpr std::size_t kUsualProfiles = 60;

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
  const ImpactProblem problem = read_impact(config);
  ImpactResult result = solve_impact(problem, setting.observer);
  throw_if_stopped(result.convergence);
  const ImpactRecord record = impact_record(problem, result);
  CaseResult answer;
  answer.numbers = cells_of(impact_columns(), record);
  answer.facts = {facts_of(problem, result, record)};
  answer.status = status_of(result.convergence);
  answer.warnings = result.warnings;
  if (!result.reason.empty()) {
    answer.warnings.push_back({answer.converged() ? "no-rebound" : "no-film", result.reason});
  }
  answer.write = [problem, dry = record.dry, result = std::move(result)](io::Hdf5Writer& writer) {
    io::write_curves(writer, "/history", history_columns(), result.history);
    writer.nxdata("/history", "force", {"time"});
    writer.attribute("/", "default", "history");
    write_profiles(writer, problem, result);
    writer.group("/dry");
    io::write_attributes(writer, "/dry", dry_impact_columns(), dry);
    // The dry ball touches the flat where the layer would end.
    writer.attribute("/dry", "begin_s", problem.layer / problem.speed);
  };
  return answer;
}

/// By how much the peak of `tabor ehl impact` grows: matrices of all rings.
double memory_of(const io::Config& config) {
  const auto n = static_cast<double>(read_impact_settings(config).nodes);
  return 6 * sizeof(double) * n * n;
}

}  // namespace

Program impact_program() {
  return {.name = "impact",
          .summary = "a ball falls on a flat covered with a layer of liquid and rebounds",
          .keys = heads_of(impact_parameters()),
          .example = {{"ball.radius", "\"10 mm\""},
                      {"ball.mass", "\"32.5 g\""},
                      {"ball.speed", "\"0.2 m/s\""},
                      {"solids.e_prime", "\"230 GPa\""},
                      {"lubricant.viscosity", "\"0.1 Pa s\""},
                      {"lubricant.pressure_viscosity", "\"1.522e-8 1/Pa\""},
                      {"lubricant.density_law", "\"dowson-higginson\""},
                      {"lubricant.layer", "\"50 um\""}},
          .columns = heads_of(impact_columns()),
          .studies = {{"grid", "grid.nodes", "nodes", "", {0.5, 1, 2}},
                      {"domain", "grid.domain", "domain_m", "m", {0.9, 1, 1.1, 1.2}, false},
                      {"time-step", "grid.time_step", "time_step_s", "s", {2, 1, 0.5}}},
          .methods = {"larsson1994", "larsson1995", "johnson1985"},
          .solve = solve,
          .check = [](const io::Config& config) { read_impact(config); },
          .memory = memory_of};
}

}  // namespace tabor::ehl
