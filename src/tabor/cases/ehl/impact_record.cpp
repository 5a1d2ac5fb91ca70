#include "tabor/cases/ehl/impact_record.hpp"

#include <fmt/format.h>

#include <cmath>

#include "tabor/core/text.hpp"
#include "tabor/core/units.hpp"

namespace tabor::ehl {
namespace {

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

const Columns<ImpactGroups>& group_columns() {
  using Groups = ImpactGroups;
  static const Columns<Groups> all{
      {"groups.H00", "", "H00, layer over R", &Groups::layer, kAlone},
      {"groups.V0", "", "V0, speed times eta0/(E' R)", &Groups::speed, kAlone},
      {"groups.M", "", "M, mass times E'/(R eta0^2)", &Groups::mass, kAlone},
      {"groups.G", "", "G, alpha E'", &Groups::material, kAlone},
      {"groups.W", "", "W, force over E' R^2", &Groups::force, kAlone},
      {"groups.Pcl", "", "Pcl, first pressure peak over E'", &Groups::primary_pressure, kAlone},
      {"groups.Hmin", "", "Hmin, smallest film over R", &Groups::min_film, kAlone},
      {"groups.dT_over_Tr", "", "dT/Tr, delay of the smallest film", &Groups::delay, kAlone}};
  return all;
}

const Columns<ImpactMeasures>& result_columns() {
  using One = ImpactMeasures;
  static const Columns<One> all{
      {"end", "", "end", [](const One& one) { return name_of(one.end); }, kAlone},
      {"max_force_N", "N", "largest force", &One::max_force, kInTable},
      {"time_max_force_s", "s", "time of the largest force", &One::time_max_force, kAlone},
      {"min_film_m", "m", "smallest film", &One::min_film, kInTable},
      {"time_min_film_s", "s", "time of the smallest film", &One::time_min_film, kAlone},
      {"max_deformation_m", "m", "deformation", &One::max_deformation, kInTable},
      {"primary_center_pressure_Pa", "Pa", "pressure peak", &One::primary_pressure, kInTable},
      {"time_primary_center_pressure_s", "s", "time of the first pressure peak",
       &One::time_primary_pressure, kAlone},
      {"impact_time_s", "s", "impact time", &One::impact_time, kInTable},
      {"restitution", "", "restitution", &One::restitution, kInTable},
      {"rebound_speed_m_per_s", "m/s", "rebound speed", &One::rebound_speed, kAlone},
      {"turning_time_s", "s", "time of the turning point", &One::turning_time, kAlone},
      {"cavitation_time_s", "s", "time when cavitation begins", &One::cavitation_time, kAlone},
      {"phase_shift_s", "s", "smallest film behind the largest force",
       [](const One& one) { return one.time_min_film - one.time_max_force; }, kAlone}};
  return all;
}

const Columns<ImpactMeasures>& solver_columns() {
  using One = ImpactMeasures;
  static const Columns<One> all{
      {"full_start_time_s", "s", "end of the rigid stage", &One::full_start_time, kAlone},
      {"domain_m", "m", "radius of the domain", &One::domain_radius, kAlone},
      {"time_step_s", "s", "nominal time step", &One::time_step, kAlone},
      {"n_steps", "", "time steps", &One::n_steps, kAlone},
      {"n_cut_steps", "", "time steps that were cut", &One::n_cut_steps, kAlone},
      {"newton_iterations", "", "iterations", member_of(&One::count, &StepCount::newton_iterations),
       kAlone},
      {"n_factorizations", "", "factorisations",
       member_of(&One::count, &StepCount::n_factorizations), kAlone},
      {"converged", "", "converged", [](const One& one) { return one.convergence.converged(); },
       kAlone},
      {"status", "", "status", [](const One& one) { return name_of(one.convergence.status); },
       kAlone}};
  return all;
}

}  // namespace

const Columns<reference::DryImpact>& dry_impact_columns() {
  using Dry = reference::DryImpact;
  static const Columns<Dry> all{
      {"impact_time_s", "s", "contact time of the dry impact", &Dry::contact_time, kAlone},
      {"max_force_N", "N", "largest force of the dry impact", &Dry::max_force, kAlone},
      {"max_deformation_m", "m", "deformation of the dry impact", &Dry::max_approach, kAlone},
      {"max_pressure_Pa", "Pa", "largest pressure of the dry impact", &Dry::max_pressure, kAlone}};
  return all;
}

const Columns<ImpactRecord>& impact_columns() {
  using Record = ImpactRecord;
  static const Columns<Record> all =
      joined(within(result_columns(), &Record::measures), within(group_columns(), &Record::groups),
             within(below("dry", dry_impact_columns()), &Record::dry),
             Columns<Record>{{"nodes", "", "nodes", &Record::nodes, kAlone}},
             within(solver_columns(), &Record::measures));
  return all;
}

ImpactRecord impact_record(const ImpactProblem& problem, const ImpactResult& result) {
  return {.measures = result,
          .groups = groups_of(problem, result),
          .dry = reference::hertz_impact(problem.radius, problem.effective_modulus, problem.mass,
                                         problem.speed),
          .nodes = problem.nodes};
}

namespace {

std::string with_time(double value, const std::string& unit, double time) {
  return std::isnan(value) ? "-" : fmt::format("{} at {}", si(value, unit), si(time, "s"));
}

}  // namespace

Facts facts_of(const ImpactProblem& problem, const ImpactResult& result,
               const ImpactRecord& record) {
  const reference::DryImpact& dry = record.dry;
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

}  // namespace tabor::ehl
