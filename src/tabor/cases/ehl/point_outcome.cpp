#include "tabor/cases/ehl/point_case.hpp"
#include "tabor/cases/ehl/point_parameters.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "tabor/cases/ehl/case.hpp"
#include "tabor/ehl/friction.hpp"
#include "tabor/ehl/point/dry.hpp"
#include "tabor/ehl/point/measures.hpp"

namespace tabor::ehl {

namespace {

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
Warnings warnings_of(const PointProblem& problem, bool is_still) {
  Warnings warnings;
  const double at_rest = 2 * problem.entrainment_speed;
  if (problem.roughness.size() > 0 && is_still &&
      std::abs(std::abs(problem.sliding_speed) - at_rest) > 1e-6 * at_rest) {
    warnings.push_back({"resting-roughness",
                        "The roughness is solved at rest although its surface moves. Give "
                        "motion.duration to let it move"});
  }
  return warnings;
}

}  // namespace

PointOutcome outcome_of(const io::Config& config, const PointProblem& problem,
                        const PointResult& film, const CaseSetting& setting,
                        const RoughnessNotes& notes) {
  PointMeasures measures = measure_point(problem, film);
  const Warnings voids = void_friction(problem.lubricant.shear, problem.asperities,
                                       {.max_pressure = measures.max_pressure,
                                        .solid_load_share = measures.boundary_load_share,
                                        .max_shear_stress = measures.max_shear_stress,
                                        .fluid = measures.friction_fluid,
                                        .solid = measures.friction_solid,
                                        .coefficient = measures.friction_coefficient});
  PointOutcome outcome{.problem = problem, .record = point_record(problem, film, measures)};
  if (read_point_settings(config).roughness.file) {
    outcome.record.scan = {.path = named_file(config, "roughness.file").string(),
                           .sha256 = notes.scan_sha256};
  }
  for (const auto& more :
       {notes.warnings, film.warnings, voids, warnings_of(problem, !has_transient(config))}) {
    add(more, outcome.warnings);
  }
  if (!film.convergence.converged()) {
    outcome.warnings.push_back(
        {"no-film", fmt::format("The film was not found ({}). Try more nodes, or a sweep down "
                                "from a higher speed",
                                name_of(film.convergence.status))});
  }
  outcome.write = [problem, film, observer = setting.observer](io::Hdf5Writer& writer) {
    const std::optional<PointResult> smooth = smooth_film(problem, observer);
    write_point(writer, problem, film, smooth ? &*smooth : nullptr);
  };
  return outcome;
}

void add_dry_contact(const Observer& observer, PointOutcome& outcome) {
  const PointResult dry = solve_point_dry(outcome.problem, observer);
  throw_if_stopped(dry.convergence);
  outcome.record.dry = {.measures = measure_point(outcome.problem, dry),
                        .convergence = dry.convergence};
  add(dry.warnings, outcome.warnings);
  if (!dry.convergence.converged()) {
    outcome.warnings.push_back({"dry-contact", fmt::format("The dry contact was not found ({})",
                                                           name_of(dry.convergence.status))});
  }
}

CaseResult result_of(const PointOutcome& outcome) {
  return {.numbers = cells_of(point_columns(), outcome.record),
          .facts = facts_of(outcome.problem, outcome.record),
          .status = status_of(outcome.convergence()),
          .warnings = outcome.warnings,
          .write = outcome.write};
}

}  // namespace tabor::ehl
