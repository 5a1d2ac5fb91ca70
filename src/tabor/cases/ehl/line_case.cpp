#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <optional>

#include "tabor/cases/ehl/line_parameters.hpp"
#include "tabor/cases/ehl/program.hpp"
#include "tabor/cases/ehl/wear_case.hpp"
#include "tabor/core/units.hpp"
#include "tabor/ehl/friction.hpp"

namespace tabor::ehl {

namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

void write_profile(io::Hdf5Writer& writer, const LineProblem& problem, const LineResult& result) {
  const reference::HertzLineContact hertz = hertz_of(problem);
  const Eigen::ArrayXd dry = result.x.unaryExpr([&](double x) { return hertz.pressure(x); });
  struct Curve {
    const char* path;
    const char* unit;
    const char* long_name;
    const Eigen::ArrayXd& values;
  };
  writer.group("/profile");
  for (const Curve& curve :
       {Curve{"/profile/x", "m", "position along the flow, from the line of closest approach",
              result.x},
        Curve{"/profile/pressure", "Pa", "pressure", result.pressure},
        Curve{"/profile/asperity_pressure", "Pa", "pressure of asperities",
              result.asperity_pressure},
        Curve{"/profile/film", "m", "film thickness", result.film},
        Curve{"/profile/shear_stress", "Pa", "shear stress of film and solids",
              result.shear_stress},
        Curve{"/profile/local_friction", "", "shear stress over pressure", result.local_friction},
        Curve{"/profile/hertz_pressure", "Pa", "pressure of the dry contact", dry}}) {
    if (curve.values.size() == 0) continue;  // no asperities
    const double* const begin = curve.values.data();
    writer.write(curve.path, std::vector<double>(begin, begin + curve.values.size()));
    writer.describe(curve.path, curve.unit, curve.long_name);
  }
  writer.nxdata("/profile", "film", {"x"});
  writer.attribute("/", "default", "profile");
}

/// Takes away the friction that nobody can know, and says why.
Warnings void_friction(const LineProblem& problem, LineResult& result) {
  Warnings warnings = ehl::void_friction(problem.lubricant.shear, problem.asperities,
                                         {.max_pressure = result.pressure.maxCoeff(),
                                          .solid_load_share = result.asperity_load_share,
                                          .max_shear_stress = result.max_shear_stress,
                                          .fluid = result.friction_fluid,
                                          .solid = result.friction_solid,
                                          .coefficient = result.friction_coefficient},
                                         "Line contacts know no other law");
  if (!warnings.empty()) result.friction_force = result.friction_coefficient * problem.load;
  if (std::isnan(result.max_shear_stress)) {
    result.shear_stress.setConstant(kNone);
    result.local_friction.setConstant(kNone);
  }
  return warnings;
}

/// What one asperity changes, where the case has one: the film is solved without it, too.
std::optional<AsperityEffect> effect_of(const io::Config& config, const LineProblem& problem,
                                        const LineResult& result, const CaseSetting& setting) {
  const auto asperity = read_single_asperity(config);
  if (!asperity) return std::nullopt;
  LineProblem without = problem;
  without.roughness -= asperity->heights(problem);
  LineResult smooth = solve_line(without, setting.observer);
  throw_if_stopped(smooth.convergence);
  void_friction(without, smooth);
  if (!smooth.convergence.converged()) {
    smooth.pressure.setConstant(kNone);
    smooth.local_friction.setConstant(kNone);
  }
  return asperity_effect(result, smooth, asperity->width, asperity->place);
}

void void_friction(WearResult& wear) {
  for (WearInstant& at : wear.history) at.friction_coefficient = kNone;
}

/// What to tell of a film that was not found: whose numbers are shown, and what to try.
std::string without_film(const LineResult& result) {
  if (result.roughness_share == 0) {
    return "A film was only found without the roughness; these numbers are those of smooth bodies. "
           "Try more nodes or a lower roughness";
  }
  if (result.roughness_share < 1) {
    return fmt::format(
        "A film was only found up to {:.0f} % of the roughness; these numbers are from there. Try "
        "more nodes or a lower roughness",
        std::floor(100 * result.roughness_share));
  }
  return fmt::format(
      "The film was not found ({}). Try more nodes, a lower load or a lower viscosity",
      name_of(result.convergence.status));
}

void warn_of_convergence(const LineResult& result, const LineRecord& record, Warnings& warnings) {
  if (!result.convergence.converged()) warnings.push_back({"no-film", without_film(result)});
  if (record.wear && !record.wear->convergence.converged()) {
    warnings.push_back({"lost-film", "The film was lost while the track wore"});
  }
}

CaseResult solve(const io::Config& config, const CaseSetting& setting) {
  const LineProblem problem = read_line(config, setting);
  LineResult result = solve_line(problem, setting.observer);
  throw_if_stopped(result.convergence);
  CaseResult answer;
  const Warnings voids = void_friction(problem, result);
  LineRecord record = line_record(problem, result);
  record.single_asperity = effect_of(config, problem, result, setting);
  add(result.warnings, answer.warnings);
  add(voids, answer.warnings);
  std::optional<WearResult> wear;
  if (read_line_settings(config).wear.coefficient) {
    wear = solve_wear(read_wear(config, problem), setting.observer);
    throw_if_stopped(wear->convergence);
    if (!voids.empty()) void_friction(*wear);
    record.wear = wear_record(config, *wear);
    add(wear->warnings, answer.warnings);
  }
  warn_of_convergence(result, record, answer.warnings);
  answer.numbers = cells_of(line_columns(), record);
  answer.facts = facts_of(problem, result, record);
  answer.status = status_of(record.convergence());
  answer.write = [problem, wear, result = std::move(result)](io::Hdf5Writer& writer) {
    write_profile(writer, problem, result);
    if (wear) write_wear(writer, *wear);
  };
  return answer;
}

void check_line_case(const io::Config& config) {
  const LineProblem problem = read_smooth_line(config);
  read_single_asperity(config);
  if (read_line_settings(config).wear.coefficient) read_wear(config, problem);
}

/// By how much the peak of `tabor ehl line` grows.
double memory_of(const io::Config& config) {
  const auto n = static_cast<double>(read_line_settings(config).nodes);
  return sizeof(double) * n * n;
}

}  // namespace

Program line_program() {
  return {.name = "line",
          .summary = "a film between a cylinder and a flat, smooth, rough, touching or worn",
          .keys = heads_of(line_parameters()),
          .example = {{"cylinder.radius", "\"2.5 mm\""},
                      {"cylinder.load_per_length", "\"5000 N/m\""},
                      {"motion.entrainment_speed", "\"7.9 mm/s\""},
                      {"motion.sliding_speed", "\"15.8 mm/s\""},
                      {"solids.youngs_modulus", "\"1.05 GPa\""},
                      {"solids.poissons_ratio", "0.35"},
                      {"lubricant.viscosity", "\"0.3638 Pa s\""},
                      {"lubricant.pressure_viscosity", "\"5.9e-9 1/Pa\""}},
          .files = {"roughness.file"},
          .columns = heads_of(line_columns()),
          .studies = {{"grid", "grid.nodes", "nodes", "", {0.5, 1, 2}},
                      {"domain", "grid.inlet", "inlet_m", "m", {0.7, 1, 1.4, 2}, false}},
          .methods = {"moes1992", "evans2000", "johnson1985"},
          .solve = solve,
          .check = [](const io::Config& config) { check_line_case(config); },
          .memory = memory_of};
}

}  // namespace tabor::ehl
