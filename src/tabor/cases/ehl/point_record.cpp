#include "tabor/cases/ehl/point_record.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "tabor/core/text.hpp"
#include "tabor/core/units.hpp"

namespace tabor::ehl {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// Where they hold: ellipses across the flow; Hamrock and Dowson need a piezoviscous liquid.
PointFormulas formulas_of(const PointProblem& problem) {
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

/// The mean central film over the rms roughness of the contact; NaN between smooth bodies.
double lambda_ratio(const PointProblem& problem, const PointMeasures& measures) {
  const double rms = rms_roughness(problem);
  return rms > 0 ? measures.mean_central_film / rms : std::numeric_limits<double>::quiet_NaN();
}

const Columns<PointMeasures>& hertz_columns() {
  using One = PointMeasures;
  static const Columns<One> all{
      {"hertz_radius_m", "m", "radius of the dry contact", &One::hertz_radius, kAlone},
      {"hertz_pressure_Pa", "Pa", "largest pressure of the dry contact", &One::hertz_pressure,
       kAlone}};
  return all;
}

const Columns<reference::PointContactFilm>& group_columns() {
  using Groups = reference::PointContactFilm;
  static const Columns<Groups> all{{"M", "", "Moes' M", &Groups::moes_load, kAlone},
                                   {"L", "", "Moes' L", &Groups::moes_viscosity, kAlone}};
  return all;
}

/// A film in the units that `length` names.
auto film_in(double PointMeasures::*film, double PointRecord::*length) {
  return [=](const PointRecord& one) { return one.measures.*film / (one.*length); };
}

const Columns<PointRecord>& film_columns() {
  using Record = PointRecord;
  using One = PointMeasures;
  const auto of = [](double One::*number) { return member_of(&Record::measures, number); };
  static const Columns<Record> all{
      {"central_film_m", "m", "central film", of(&One::central_film), kInTable},
      {"min_film_m", "m", "smallest film", of(&One::min_film), kInTable},
      {"Hc", "", "Hc", film_in(&One::central_film, &Record::moes_length), kInTable},
      {"Hm", "", "Hm", film_in(&One::min_film, &Record::moes_length), kInTable},
      {"lambda_ratio", "", "film / rms roughness", &Record::lambda_ratio, kInTableWhereKnown},
      {"film_at_centre_m", "m", "film in the centre", of(&One::film_at_centre), kAlone},
      {"mean_central_film_m", "m", "mean central film", of(&One::mean_central_film), kAlone},
      {"hertz_units.Hc", "", "Hc in units of a^2/Rx",
       film_in(&One::central_film, &Record::hertz_length), kAlone},
      {"hertz_units.Hm", "", "Hm in units of a^2/Rx",
       film_in(&One::min_film, &Record::hertz_length), kAlone}};
  return all;
}

const Columns<PointMeasures>& load_columns() {
  using One = PointMeasures;
  static const Columns<One> all{
      {"max_pressure_Pa", "Pa", "largest pressure", &One::max_pressure, kInTable},
      {"solid_contact_fraction", "", "solid contact", &One::solid_contact_fraction, kInTable},
      {"contact_load_share", "", "load share of solids", &One::contact_load_share, kAlone},
      {"boundary_load_share", "", "load share of solids that touch without flowing",
       &One::boundary_load_share, kAlone},
      {"plastic_fraction", "", "plastic", &One::plastic_fraction, kInTable},
      {"max_plastic_depth_m", "m", "largest plastic depth", &One::max_plastic_depth, kAlone},
      {"fluid_volume_m3", "m^3", "volume of the film", &One::fluid_volume, kAlone},
      {"friction_fluid", "", "fluid friction", &One::friction_fluid, kInTable},
      {"friction_solid", "", "solid friction", &One::friction_solid, kInTable},
      {"friction_coefficient", "", "friction", &One::friction_coefficient, kInTable},
      {"max_shear_stress_Pa", "Pa", "largest shear stress of the film", &One::max_shear_stress,
       kAlone}};
  return all;
}

const Columns<PointFormulas>& formula_columns() {
  using One = PointFormulas;
  static const Columns<One> all{
      {"formulas.nijenbanning_central_film_m", "m", "central film by Nijenbanning et al.",
       &One::nijenbanning, kAlone},
      {"formulas.hamrock_dowson_central_film_m", "m", "central film by Hamrock and Dowson",
       &One::hamrock_dowson_central, kAlone},
      {"formulas.hamrock_dowson_min_film_m", "m", "smallest film by Hamrock and Dowson",
       &One::hamrock_dowson_min, kAlone}};
  return all;
}

const Columns<PointRecord>& case_columns() {
  using Record = PointRecord;
  const auto of = [](auto number) { return member_of(&Record::convergence, number); };
  static const Columns<Record> all{
      {"load_N", "N", "load", &Record::load, kAlone},
      {"entrainment_speed_m_per_s", "m/s", "entrainment speed", &Record::entrainment_speed, kAlone},
      {"sliding_speed_m_per_s", "m/s", "sliding speed", &Record::sliding_speed, kAlone},
      {"roughness_rms_m", "m", "rms roughness", &Record::roughness_rms, kAlone},
      {"nodes_x", "", "nodes along the flow", &Record::nodes_x, kAlone},
      {"nodes_y", "", "nodes across the flow", &Record::nodes_y, kAlone},
      {"domain", "", "factor on the domain", [](const Record&) { return 1; }, kAlone},
      {"spacing_m", "m", "spacing of the nodes", &Record::spacing, kAlone},
      {"newton_iterations", "", "iterations", of(&Convergence::iterations), kCountInTable},
      {"n_products", "", "products of the operator", of(&Convergence::operator_applications),
       kAlone},
      {"load_error", "", "relative error of the load", &Record::load_error, kAlone},
      {"mass_error", "", "relative error of the flow", &Record::mass_error, kAlone},
      {"converged", "", "converged", [](const Record& one) { return one.convergence.converged(); },
       kAlone},
      {"status", "", "status", [](const Record& one) { return name_of(one.convergence.status); },
       kAlone}};
  return all;
}

const Columns<DryPointContact>& dry_columns() {
  using Dry = DryPointContact;
  using One = PointMeasures;
  const auto of = [](double One::*number) { return member_of(&Dry::measures, number); };
  static const Columns<Dry> all{
      {"dry.solid_contact_fraction", "", "contact without liquid", of(&One::solid_contact_fraction),
       kAlone},
      {"dry.plastic_fraction", "", "plastic without liquid", of(&One::plastic_fraction), kAlone},
      {"dry.max_pressure_Pa", "Pa", "largest pressure without liquid", of(&One::max_pressure),
       kAlone},
      {"dry.max_plastic_depth_m", "m", "largest plastic depth without liquid",
       of(&One::max_plastic_depth), kAlone},
      {"dry.friction_solid", "", "friction without liquid", of(&One::friction_solid), kAlone},
      {"dry.converged", "", "converged without liquid",
       [](const Dry& one) { return one.convergence.converged(); }, kAlone},
      {"dry.status", "", "status without liquid",
       [](const Dry& one) { return name_of(one.convergence.status); }, kAlone}};
  return all;
}

const Columns<PointHistory>& history_columns() {
  using One = PointHistory;
  const auto at_thinnest = [](auto number) { return member_of(&One::thinnest, number); };
  const auto at_hardest = [](auto number) { return member_of(&One::hardest, number); };
  static const Columns<One> all{{"history.steps", "", "time steps", &One::n_steps, kAlone},
                                {"history.end_s", "s", "time at the end", &One::end, kAlone},
                                {"history.roughness_speed_m_per_s", "m/s", "speed of the roughness",
                                 &One::roughness_speed, kAlone},
                                {"history.min_film_m", "m", "smallest film of all times",
                                 at_thinnest(&PointMoment::min_film), kAlone},
                                {"history.time_min_film_s", "s", "time of the smallest film",
                                 at_thinnest(&PointMoment::time), kAlone},
                                {"history.max_pressure_Pa", "Pa", "largest pressure of all times",
                                 at_hardest(&PointMoment::max_pressure), kAlone},
                                {"history.time_max_pressure_s", "s", "time of the largest pressure",
                                 at_hardest(&PointMoment::time), kAlone}};
  return all;
}

const Columns<PointScan>& scan_columns() {
  static const Columns<PointScan> all{
      {"scan.path", "", "scan", &PointScan::path, kAlone},
      {"scan.sha256", "", "SHA-256 of the scan", &PointScan::sha256, kAlone}};
  return all;
}

}  // namespace

const Columns<PointRecord>& point_columns() {
  using Record = PointRecord;
  static const Columns<Record> all =
      joined(within(hertz_columns(), &Record::measures), within(group_columns(), &Record::groups),
             film_columns(), within(load_columns(), &Record::measures),
             within(formula_columns(), &Record::formulas), case_columns(),
             within(scan_columns(), &Record::scan), within(dry_columns(), &Record::dry),
             within(history_columns(), &Record::history));
  return all;
}

PointRecord point_record(const PointProblem& problem, const PointResult& result,
                         const PointMeasures& measures) {
  const double half_axis = hertz_of(problem).half_axis_x;
  return {.measures = measures,
          .groups = film_groups_of(problem),
          .formulas = formulas_of(problem),
          .moes_length = moes_length(problem),
          .hertz_length = half_axis * half_axis / problem.radius_x,
          .load = problem.load,
          .entrainment_speed = problem.entrainment_speed,
          .sliding_speed = problem.sliding_speed,
          .roughness_rms = rms_roughness(problem),
          .lambda_ratio = lambda_ratio(problem, measures),
          .nodes_x = problem.nodes_x,
          .nodes_y = problem.nodes_y,
          .spacing = result.grid.dx(),
          .load_error = result.load_error,
          .mass_error = result.mass_error,
          .convergence = result.convergence};
}

namespace {

std::string with_moes(double film, double unit) {
  return fmt::format("{} ({} in Moes' units)", si(film, "m"), plain(film / unit));
}

std::string friction_text(const PointMeasures& measures) {
  const bool is_known = std::isfinite(measures.friction_coefficient);
  return fmt::format("{}: {} of the film, {} of solids",
                     is_known ? plain(measures.friction_coefficient) : "not known",
                     plain(measures.friction_fluid), plain(measures.friction_solid));
}

void describe_film(const PointRecord& record, Facts& facts) {
  const PointMeasures& measures = record.measures;
  const PointFormulas& formulas = record.formulas;
  const double unit = record.moes_length;
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

void describe_solids(const PointProblem& problem, const PointRecord& record, Facts& facts) {
  const PointMeasures& measures = record.measures;
  if (problem.roughness.size() > 0) {
    facts.push_back({"roughness", si(record.roughness_rms, "m") + " rms in the contact"});
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

Facts film_facts(const PointProblem& problem, const PointRecord& record) {
  const PointMeasures& measures = record.measures;
  const reference::HertzEllipse hertz = hertz_of(problem);
  const reference::PointContactFilm& groups = record.groups;
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
  describe_film(record, facts);
  facts.push_back({"largest pressure", si(measures.max_pressure, "Pa")});
  describe_solids(problem, record, facts);
  if (problem.sliding_speed != 0) facts.push_back({"friction", friction_text(measures)});
  facts.push_back(
      {"solved",
       fmt::format("{} x {} nodes, {} iterations; load balanced to {:.1g}, mass to {:.1g}",
                   problem.nodes_x, problem.nodes_y, record.convergence.iterations,
                   record.load_error, record.mass_error)});
  return facts;
}

Facts dry_facts(const PointMeasures& measures) {
  const std::string friction = std::isnan(measures.friction_solid)
                                   ? "not known without [asperities]"
                                   : plain(measures.friction_solid);
  return {{"without any liquid", fmt::format("{} of the area touches, {} is plastic, friction {}",
                                             percent(measures.solid_contact_fraction),
                                             percent(measures.plastic_fraction), friction)}};
}

Facts history_facts(const PointHistory& history) {
  return {{"all this at", fmt::format("{}, after {} steps", si(history.end, "s"), history.n_steps)},
          {"on the way",
           fmt::format("film down to {} at {}, pressure up to {} at {}",
                       si(history.thinnest.min_film, "m"), si(history.thinnest.time, "s"),
                       si(history.hardest.max_pressure, "Pa"), si(history.hardest.time, "s"))},
          {"speed of roughness", si(history.roughness_speed, "m/s")}};
}

}  // namespace

std::vector<Facts> facts_of(const PointProblem& problem, const PointRecord& record) {
  std::vector<Facts> groups = {film_facts(problem, record)};
  if (record.dry) groups.push_back(dry_facts(record.dry->measures));
  if (record.history) groups.push_back(history_facts(*record.history));
  return groups;
}

}  // namespace tabor::ehl
