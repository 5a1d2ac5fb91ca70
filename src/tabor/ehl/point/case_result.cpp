#include "tabor/ehl/point/case.hpp"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <optional>

#include "tabor/core/units.hpp"
#include "tabor/ehl/case.hpp"
#include "tabor/ehl/friction.hpp"
#include "tabor/ehl/point/dry.hpp"
#include "tabor/ehl/point/measures.hpp"

namespace tabor::ehl {

namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// Films of formulas for smooth bodies.
struct Formulas {
  double nijenbanning = 0;            ///< [m], in the centre, over the density at Hertz' pressure
  double hamrock_dowson_central = 0;  ///< [m]
  double hamrock_dowson_min = 0;      ///< [m]
};

/// Where they hold: ellipses across the flow; Hamrock and Dowson need a piezoviscous liquid.
Formulas formulas_of(const PointProblem& problem) {
  const reference::PointContactFilm groups = film_groups_of(problem);
  const double density = problem.lubricant.density.at(hertz_of(problem).max_pressure).value;
  const bool is_covered = problem.radius_y >= problem.radius_x;
  const bool is_piezoviscous = is_covered && groups.pressure_coefficient > 0;
  return {
      .nijenbanning = is_covered ? groups.nijenbanning_central() / density : kNone,
      .hamrock_dowson_central = is_piezoviscous ? groups.hamrock_dowson_central() : kNone,
      .hamrock_dowson_min = is_piezoviscous ? groups.hamrock_dowson_min() : kNone,
  };
}

/// [m] of a film of 1 in Moes' units, h / (Rx sqrt(2 U)).
double moes_length(const PointProblem& problem) {
  return problem.radius_x * std::sqrt(2 * film_groups_of(problem).speed_group());
}

/// [m], over the area of the dry contact; 0 for smooth bodies.
double rms_roughness(const PointProblem& problem) {
  if (problem.roughness.size() == 0) return 0;
  const Mask area = hertz_area(problem);
  const auto n = static_cast<double>(area.count());
  const double mean = area.select(problem.roughness, 0.0).sum() / n;
  return std::sqrt(area.select((problem.roughness - mean).square(), 0.0).sum() / n);
}

io::Json formulas_json(const PointProblem& problem) {
  const Formulas formulas = formulas_of(problem);
  return {{"nijenbanning_central_film_m", io::number(formulas.nijenbanning)},
          {"hamrock_dowson_central_film_m", io::number(formulas.hamrock_dowson_central)},
          {"hamrock_dowson_min_film_m", io::number(formulas.hamrock_dowson_min)}};
}

/// Films in units of a^2 / Rx, a along the flow, as numerical papers scale them.
io::Json hertz_units_json(const PointProblem& problem, const PointMeasures& measures) {
  const double a = hertz_of(problem).half_axis_x;
  const double unit = a * a / problem.radius_x;
  return {{"Hc", io::number(measures.central_film / unit)},
          {"Hm", io::number(measures.min_film / unit)}};
}

io::Json scalars_of(const PointProblem& problem, const PointResult& result,
                    const PointMeasures& measures) {
  const reference::PointContactFilm groups = film_groups_of(problem);
  const double unit = moes_length(problem);
  return {{"hertz_radius_m", measures.hertz_radius},
          {"hertz_pressure_Pa", measures.hertz_pressure},
          {"M", groups.moes_load()},
          {"L", groups.moes_viscosity()},
          {"central_film_m", io::number(measures.central_film)},
          {"min_film_m", io::number(measures.min_film)},
          {"Hc", io::number(measures.central_film / unit)},
          {"Hm", io::number(measures.min_film / unit)},
          {"film_at_centre_m", io::number(measures.film_at_centre)},
          {"mean_central_film_m", io::number(measures.mean_central_film)},
          {"hertz_units", hertz_units_json(problem, measures)},
          {"max_pressure_Pa", io::number(measures.max_pressure)},
          {"solid_contact_fraction", io::number(measures.solid_contact_fraction)},
          {"contact_load_share", io::number(measures.contact_load_share)},
          {"boundary_load_share", io::number(measures.boundary_load_share)},
          {"plastic_fraction", io::number(measures.plastic_fraction)},
          {"max_plastic_depth_m", io::number(measures.max_plastic_depth)},
          {"fluid_volume_m3", io::number(measures.fluid_volume)},
          {"friction_fluid", io::number(measures.friction_fluid)},
          {"friction_solid", io::number(measures.friction_solid)},
          {"friction_coefficient", io::number(measures.friction_coefficient)},
          {"max_shear_stress_Pa", io::number(measures.max_shear_stress)},
          {"formulas", formulas_json(problem)},
          {"load_N", problem.load},
          {"entrainment_speed_m_per_s", problem.entrainment_speed},
          {"sliding_speed_m_per_s", problem.sliding_speed},
          {"roughness_rms_m", rms_roughness(problem)},
          {"nodes_x", problem.nodes_x},
          {"nodes_y", problem.nodes_y},
          {"domain", 1},
          {"spacing_m", result.grid.dx()},
          {"newton_iterations", result.convergence.iterations},
          {"n_products", result.convergence.operator_applications},
          {"load_error", io::number(result.load_error)},
          {"mass_error", io::number(result.mass_error)},
          {"converged", result.convergence.converged()},
          {"status", name_of(result.convergence.status)}};
}

std::string with_moes(double film, double unit) {
  return fmt::format("{} ({} in Moes' units)", si(film, "m"), plain(film / unit));
}

std::string friction_text(const PointMeasures& measures) {
  const bool is_known = std::isfinite(measures.friction_coefficient);
  return fmt::format("{}: {} of the film, {} of solids",
                     is_known ? plain(measures.friction_coefficient) : "not known",
                     plain(measures.friction_fluid), plain(measures.friction_solid));
}

void describe_film(Facts& facts, const PointProblem& problem, const PointMeasures& measures) {
  const Formulas formulas = formulas_of(problem);
  const double unit = moes_length(problem);
  facts.push_back({"film in the centre", with_moes(measures.film_at_centre, unit)});
  facts.push_back({"mean central film", with_moes(measures.mean_central_film, unit)});
  facts.push_back({"smallest film", with_moes(measures.min_film, unit)});
  if (std::isfinite(formulas.nijenbanning)) {
    facts.push_back({"smooth, Newtonian", fmt::format("{} in the centre (Nijenbanning et al.)",
                                                      si(formulas.nijenbanning, "m"))});
  }
  if (std::isfinite(formulas.hamrock_dowson_min)) {
    facts.push_back({" ", fmt::format("{} in the centre, {} at least (Hamrock and Dowson)",
                                      si(formulas.hamrock_dowson_central, "m"),
                                      si(formulas.hamrock_dowson_min, "m"))});
  }
}

void describe_solids(Facts& facts, const PointProblem& problem, const PointMeasures& measures) {
  if (problem.roughness.size() > 0) {
    facts.push_back({"roughness", si(rms_roughness(problem), "m") + " rms in the contact"});
  }
  if (problem.roughness.size() > 0 || measures.solid_contact_fraction > 0) {
    facts.push_back({"solids touch", fmt::format("{} of the contact's area, {} of the load",
                                                 percent(measures.solid_contact_fraction),
                                                 percent(measures.contact_load_share))});
  }
  if (std::isfinite(problem.plastic_pressure)) {
    facts.push_back({"plastic", fmt::format("{} of the area, {} deep at most",
                                            percent(measures.plastic_fraction),
                                            si(measures.max_plastic_depth, "m"))});
  }
}

Facts facts_of(const PointProblem& problem, const PointResult& result,
               const PointMeasures& measures) {
  const reference::HertzEllipse hertz = hertz_of(problem);
  const reference::PointContactFilm groups = film_groups_of(problem);
  Facts facts;
  facts.push_back(
      {"load, speeds",
       fmt::format("{}, entrainment {}, sliding {}", si(problem.load, "N"),
                   si(problem.entrainment_speed, "m/s"), si(problem.sliding_speed, "m/s"))});
  facts.push_back(
      {"dry contact", fmt::format("half axes {} x {}, {}", si(hertz.half_axis_x, "m"),
                                  si(hertz.half_axis_y, "m"), si(hertz.max_pressure, "Pa"))});
  facts.push_back({"Moes' groups", fmt::format("M = {}, L = {}", plain(groups.moes_load()),
                                               plain(groups.moes_viscosity()))});
  describe_film(facts, problem, measures);
  facts.push_back({"largest pressure", si(measures.max_pressure, "Pa")});
  describe_solids(facts, problem, measures);
  if (problem.sliding_speed != 0) facts.push_back({"friction", friction_text(measures)});
  facts.push_back(
      {"solved",
       fmt::format("{} x {} nodes, {} iterations; load balanced to {:.1g}, mass to {:.1g}",
                   problem.nodes_x, problem.nodes_y, result.convergence.iterations,
                   result.load_error, result.mass_error)});
  return facts;
}

/// The film of the same bodies without their roughness, to show behind it; nothing if they have
/// none.
std::optional<PointResult> smooth_film(PointProblem problem, const Observer& observer) {
  if (problem.roughness.size() == 0) return std::nullopt;
  problem.roughness.resize(0, 0);
  PointResult smooth = solve_point(problem, nullptr, observer);
  throw_if_stopped(smooth.convergence);
  return smooth;
}

/// What the equations do not see.
std::vector<std::string> warnings_of(const PointProblem& problem, bool is_still) {
  std::vector<std::string> warnings;
  const double at_rest = 2 * problem.entrainment_speed;
  if (problem.roughness.size() > 0 && is_still &&
      std::abs(std::abs(problem.sliding_speed) - at_rest) > 1e-6 * at_rest) {
    warnings.emplace_back(
        "the roughness is taken to stand still, but its surface moves: only a "
        "sliding speed of twice the entrainment speed is steady; motion.duration lets it move");
  }
  return warnings;
}

}  // namespace

CaseResult point_result(const io::Config& config, const PointProblem& problem,
                        const PointResult& result, const CaseSetting& setting,
                        const RoughnessNotes& notes) {
  PointMeasures measures = measure_point(problem, result);
  const std::vector<std::string> voids =
      void_friction(problem.lubricant.shear, problem.asperities,
                    {.max_pressure = measures.max_pressure,
                     .solid_load_share = measures.boundary_load_share,
                     .max_shear_stress = measures.max_shear_stress,
                     .fluid = measures.friction_fluid,
                     .solid = measures.friction_solid,
                     .coefficient = measures.friction_coefficient});
  CaseResult answer;
  answer.scalars = scalars_of(problem, result, measures);
  if (config.has("roughness.file")) {
    const std::filesystem::path scan = named_file(config, "roughness.file");
    answer.scalars["scan"] = {{"path", scan.string()}, {"sha256", notes.scan_sha256}};
  }
  answer.facts = {facts_of(problem, result, measures)};
  answer.converged = result.convergence.converged();
  answer.warnings = notes.warnings;
  for (const auto& more : {result.warnings, voids, warnings_of(problem, !has_passage(config))}) {
    answer.warnings.insert(answer.warnings.end(), more.begin(), more.end());
  }
  if (!result.convergence.converged()) {
    answer.warnings.push_back(
        fmt::format("the film was not found ({}): more nodes, or a sweep that comes down from a "
                    "higher speed",
                    name_of(result.convergence.status)));
  }
  answer.write = [problem, result, observer = setting.observer](io::Hdf5Writer& writer) {
    const std::optional<PointResult> smooth = smooth_film(problem, observer);
    write_point(writer, problem, result, smooth ? &*smooth : nullptr);
  };
  return answer;
}

void add_dry_contact(const PointProblem& problem, const Observer& observer, CaseResult& answer) {
  const PointResult result = solve_point_dry(problem, observer);
  throw_if_stopped(result.convergence);
  const PointMeasures measures = measure_point(problem, result);
  answer.scalars["dry"] = {{"solid_contact_fraction", io::number(measures.solid_contact_fraction)},
                           {"plastic_fraction", io::number(measures.plastic_fraction)},
                           {"max_pressure_Pa", io::number(measures.max_pressure)},
                           {"max_plastic_depth_m", io::number(measures.max_plastic_depth)},
                           {"friction_solid", io::number(measures.friction_solid)},
                           {"converged", result.convergence.converged()},
                           {"status", name_of(result.convergence.status)}};
  const std::string friction = std::isnan(measures.friction_solid)
                                   ? "not known without [asperities]"
                                   : plain(measures.friction_solid);
  Facts facts;
  facts.push_back(
      {"without any liquid", fmt::format("{} of the area touches, {} is plastic, friction {}",
                                         percent(measures.solid_contact_fraction),
                                         percent(measures.plastic_fraction), friction)});
  answer.facts.push_back(std::move(facts));
  if (!result.convergence.converged()) {
    answer.warnings.push_back(
        fmt::format("the dry contact was not found ({})", name_of(result.convergence.status)));
  }
}

}  // namespace tabor::ehl
