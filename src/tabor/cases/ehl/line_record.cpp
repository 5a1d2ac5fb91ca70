#include "tabor/cases/ehl/line_record.hpp"

#include <fmt/format.h>

#include "tabor/core/text.hpp"
#include "tabor/core/units.hpp"

namespace tabor::ehl {
namespace {

const Columns<LineMeasures>& film_columns() {
  using One = LineMeasures;
  static const Columns<One> all{
      {"min_film_m", "m", "smallest film", &One::min_film, kInTable},
      {"central_film_m", "m", "central film", &One::central_film, kInTable},
      {"max_pressure_Pa", "Pa", "largest pressure", &One::max_pressure, kInTable},
      {"max_pressure_before_spike_Pa", "Pa", "largest pressure before the spike",
       &One::max_pressure_before_spike, kAlone},
      {"rupture_m", "m", "place where the film ends", &One::rupture, kAlone},
      {"max_shear_stress_Pa", "Pa", "largest stress", &One::max_shear_stress, kInTable},
      {"friction_force_N_per_m", "N/m", "friction force", &One::friction_force, kAlone},
      {"friction_coefficient", "", "friction", &One::friction_coefficient, kInTable}};
  return all;
}

const Columns<LineMeasures>& solver_columns() {
  using One = LineMeasures;
  static const Columns<One> all{
      {"newton_iterations", "", "iterations",
       member_of(&One::convergence, &Convergence::iterations), kCountInTable},
      {"n_products", "", "products of the operator",
       member_of(&One::convergence, &Convergence::operator_applications), kAlone},
      {"load_error", "", "relative error of the load", &One::load_error, kAlone},
      {"mass_error", "", "relative error of the flow", &One::mass_error, kAlone}};
  return all;
}

const Columns<reference::HertzLineContact>& hertz_columns() {
  using Hertz = reference::HertzLineContact;
  static const Columns<Hertz> all{
      {"hertz_half_width_m", "m", "half width of the dry contact", &Hertz::half_width, kAlone},
      {"hertz_pressure_Pa", "Pa", "largest pressure of the dry contact", &Hertz::max_pressure,
       kAlone}};
  return all;
}

const Columns<reference::LineContactFilm>& group_columns() {
  using Groups = reference::LineContactFilm;
  static const Columns<Groups> all{
      {"groups.U", "", "U, speed", &Groups::speed_group, kAlone},
      {"groups.W", "", "W, load", &Groups::load_group, kAlone},
      {"groups.G", "", "G, material", &Groups::material_group, kAlone},
      {"groups.M", "", "Moes' M", &Groups::moes_load, kAlone},
      {"groups.L", "", "Moes' L", &Groups::moes_viscosity, kAlone},
      {"moes_min_film_m", "m", "smallest film of Moes' chart", &Groups::moes_min_film, kAlone}};
  return all;
}

/// What a record has where solids can touch.
template <typename Value>
auto where_solids_touch(Value LineMeasures::*number) {
  return [number](const LineRecord& one) -> Cell {
    return one.asperities ? Cell(one.measures.*number) : Cell();
  };
}

const Columns<LineAsperities>& asperity_columns() {
  using One = LineAsperities;
  static const Columns<One> all{
      {"solid_contact_fraction", "", "contact", &One::solid_contact_fraction, kInTableWhereKnown},
      {"boundary_film_m", "m", "boundary film", &One::boundary_film, kAlone},
      {"max_asperity_pressure_Pa", "Pa", "largest pressure of asperities", &One::max_pressure,
       kAlone},
      {"max_fluid_pressure_Pa", "Pa", "largest pressure of the liquid", &One::max_fluid_pressure,
       kAlone}};
  return all;
}

const Columns<AsperityEffect>& effect_columns() {
  using Effect = AsperityEffect;
  static const Columns<Effect> all{
      {"local_friction", "", "local friction", &Effect::local_friction, kInTableWhereKnown},
      {"local_friction_ratio", "", "times smooth friction", &Effect::friction_ratio,
       kInTableWhereKnown},
      {"max_pressure_Pa", "Pa", "pressure on it", &Effect::max_pressure, kInTableWhereKnown},
      {"pressure_ratio", "", "times smooth pressure", &Effect::pressure_ratio, kInTableWhereKnown}};
  return all;
}

const Columns<WearRecord>& wear_columns() {
  using Wear = WearRecord;
  constexpr ColumnStyle kMass{.shown = Shown::unscaled, .media = kInTableWhereKnown.media};
  static const Columns<Wear> all{
      {"time_s", "s", "time", member_of(&Wear::last, &WearInstant::time), kAlone},
      {"distance_m", "m", "distance slid", member_of(&Wear::last, &WearInstant::distance), kAlone},
      {"mean_depth_m", "m", "mean wear", member_of(&Wear::last, &WearInstant::mean_depth),
       kInTableWhereKnown},
      {"max_depth_m", "m", "deepest wear", member_of(&Wear::last, &WearInstant::max_depth),
       kInTableWhereKnown},
      {"volume_per_width_m2", "m^2", "worn volume over width", &Wear::worn_area, kAlone},
      {"mass_kg", "kg", "worn mass",
       [](const Wear& one) -> Cell { return one.mass ? Cell(*one.mass) : Cell(); }, kMass},
      {"min_film_m", "m", "smallest film at the end",
       member_of(&Wear::last, &WearInstant::min_film), kAlone},
      {"thinnest_film_m", "m", "thinnest film", &Wear::thinnest_film, kInTableWhereKnown},
      {"friction_coefficient", "", "friction at the end",
       member_of(&Wear::last, &WearInstant::friction_coefficient), kAlone},
      {"time_step_s", "s", "time step", &Wear::time_step, kAlone},
      {"n_steps", "", "time steps", &Wear::n_steps, kAlone},
      {"newton_iterations", "", "iterations",
       member_of(&Wear::convergence, &Convergence::iterations), kAlone},
      {"converged", "", "converged", [](const Wear& one) { return one.convergence.converged(); },
       kAlone},
      {"status", "", "status", [](const Wear& one) { return name_of(one.convergence.status); },
       kAlone}};
  return all;
}

const Columns<LineRecord>& own_columns() {
  using Record = LineRecord;
  static const Columns<Record> all{
      {"nodes", "", "nodes", &Record::nodes, kAlone},
      {"inlet_m", "m", "domain before the centre", &Record::inlet, kAlone},
      {"outlet_m", "m", "domain behind the centre", &Record::outlet, kAlone},
      {"converged", "", "converged",
       [](const Record& one) { return one.convergence().converged(); }, kAlone},
      {"status", "", "status", [](const Record& one) { return name_of(one.convergence().status); },
       kAlone}};
  return all;
}

const Columns<LineRecord>& mixed_columns() {
  using Record = LineRecord;
  static const Columns<Record> all = joined(
      Columns<Record>{{"friction_fluid", "", "of the film",
                       where_solids_touch(&LineMeasures::friction_fluid), kInTableWhereKnown},
                      {"friction_solid", "", "of solids",
                       where_solids_touch(&LineMeasures::friction_solid), kInTableWhereKnown},
                      {"asperity_load_share", "", "asperities",
                       where_solids_touch(&LineMeasures::asperity_load_share), kInTableWhereKnown}},
      within(asperity_columns(), &Record::asperities),
      Columns<Record>{{"contact_width_m", "m", "width of all solid contacts",
                       where_solids_touch(&LineMeasures::contact_width), kAlone},
                      {"contact_error", "", "relative error of the solid contact",
                       where_solids_touch(&LineMeasures::contact_error), kAlone}});
  return all;
}

}  // namespace

const Convergence& LineRecord::convergence() const {
  return wear && measures.convergence.converged() ? wear->convergence : measures.convergence;
}

const Columns<LineRecord>& line_columns() {
  using Record = LineRecord;
  static const Columns<Record> all =
      joined(within(film_columns(), &Record::measures), mixed_columns(),
             within(below("single_asperity", effect_columns()), &Record::single_asperity),
             within(hertz_columns(), &Record::hertz), within(group_columns(), &Record::groups),
             within(solver_columns(), &Record::measures), own_columns(),
             within(below("wear", wear_columns()), &Record::wear));
  return all;
}

LineRecord line_record(const LineProblem& problem, const LineResult& result) {
  LineRecord record{.measures = result,
                    .hertz = hertz_of(problem),
                    .groups = film_groups_of(problem),
                    .nodes = problem.nodes,
                    .inlet = -result.x[0],
                    .outlet = result.x[result.x.size() - 1]};
  if (result.asperity_pressure.size() == 0) return record;
  record.asperities = {
      .boundary_film = problem.asperities.boundary_film,
      .max_pressure = result.asperity_pressure.maxCoeff(),
      .max_fluid_pressure = result.pressure.maxCoeff(),
      .solid_contact_fraction = result.contact_width / (2 * record.hertz.half_width)};
  return record;
}

namespace {

/// Says where the grid cannot show the spike.
std::string pressure_text(const LineResult& result) {
  std::string largest = si(result.max_pressure, "Pa");
  if (!(result.max_pressure_before_spike < result.pressure.maxCoeff())) return largest;
  return fmt::format("{}, a spike that the grid does not resolve; {} before it", largest,
                     si(result.max_pressure_before_spike, "Pa"));
}

Facts film_facts(const LineProblem& problem, const LineResult& result) {
  const reference::HertzLineContact hertz = hertz_of(problem);
  Facts facts;
  facts.push_back({"smallest film", si(result.min_film, "m")});
  facts.push_back({"film in the centre", si(result.central_film, "m")});
  facts.push_back({"largest pressure", pressure_text(result)});
  facts.push_back({"film ends at", si(result.rupture, "m")});
  facts.push_back({"friction coefficient", plain(result.friction_coefficient)});
  if (result.asperity_pressure.size() > 0) {
    facts.push_back(
        {"asperities", fmt::format("{} of the load on {}, friction {} beside {} of the liquid",
                                   plain(result.asperity_load_share), si(result.contact_width, "m"),
                                   plain(result.friction_solid), plain(result.friction_fluid))});
  }
  facts.push_back({"dry contact", fmt::format("half width {}, {}", si(hertz.half_width, "m"),
                                              si(hertz.max_pressure, "Pa"))});
  facts.push_back(
      {"Moes' chart", fmt::format("M = {}, L = {}: {}", plain(film_groups_of(problem).moes_load()),
                                  plain(film_groups_of(problem).moes_viscosity()),
                                  si(film_groups_of(problem).moes_min_film(), "m"))});
  facts.push_back(
      {"solved", fmt::format("{} iterations; load balanced to {:.1g}, mass to {:.1g}",
                             result.convergence.iterations, result.load_error, result.mass_error)});
  return facts;
}

Facts effect_facts(const AsperityEffect& effect) {
  return {{"on the asperity",
           fmt::format("local friction {}, {} times that without it", plain(effect.local_friction),
                       plain(effect.friction_ratio(), 3))},
          {"", fmt::format("pressure {}, {} times that without it", si(effect.max_pressure, "Pa"),
                           plain(effect.pressure_ratio(), 3))}};
}

Facts wear_facts(const WearRecord& wear) {
  const WearInstant& last = wear.last;
  Facts facts;
  facts.push_back({"slid", fmt::format("{} in {}", si(last.distance, "m"), si(last.time, "s"))});
  facts.push_back({"worn off", fmt::format("{} on average, {} at most", si(last.mean_depth, "m"),
                                           si(last.max_depth, "m"))});
  facts.push_back({"film then", fmt::format("{}, {} at the thinnest", si(last.min_film, "m"),
                                            si(wear.thinnest_film, "m"))});
  facts.push_back({"friction then", plain(last.friction_coefficient)});
  return facts;
}

}  // namespace

std::vector<Facts> facts_of(const LineProblem& problem, const LineResult& result,
                            const LineRecord& record) {
  std::vector<Facts> groups = {film_facts(problem, result)};
  if (record.single_asperity) groups.push_back(effect_facts(*record.single_asperity));
  if (record.wear) groups.push_back(wear_facts(*record.wear));
  return groups;
}

}  // namespace tabor::ehl
