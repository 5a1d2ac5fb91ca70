#include "tabor/study/compute.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "tabor/analysis/warnings.hpp"
#include "tabor/core/error.hpp"
#include "tabor/core/resources.hpp"
#include "tabor/elastic/half_space.hpp"
#include "tabor/friction/trapped.hpp"
#include "tabor/friction/wet_contact.hpp"
#include "tabor/io/digest.hpp"

namespace tabor::study {
namespace {

/// A row that has its place and no numbers yet.
Row empty_row(const Study& study, const Scan& scan, const Unit& unit, std::size_t pressure,
              const Condition& condition) {
  Row row;
  row.case_id = unit.key;
  row.scan = scan.label;
  row.group = scan.group;
  row.mean_pressure = study.mean_pressures[pressure];
  row.lubricant_density = study.lubricant_densities[condition.density];
  if (study.flows()) row.fluid = FluidRow{.sliding_speed = study.sliding_speeds[condition.speed]};
  return row;
}

void add_contact(const StoredContact& stored, Row& row) {
  row.contact_area_fraction = stored.summary.contact_area_fraction;
  row.contact_area_fraction_pixels = stored.summary.contact_area_fraction_pixels;
  row.saturated_area_fraction = stored.summary.saturated_area_fraction;
  row.mean_gap = stored.summary.mean_gap;
  row.certificate = stored.convergence.certificate;
  row.converged = stored.convergence.converged;
  row.warnings = stored.warnings;
}

void add_liquid(const StoredContact& stored, const Field& film, bool periodic, Row& row) {
  if (film.rows() != stored.gap.rows() || film.cols() != stored.gap.cols()) {
    throw InputError("the store", "a film and a contact of two sizes", "both of one surface",
                     "remove the folder store and run the sweep again");
  }
  row.lubricated_share = friction::lubricated_share(stored.contact, film);
  row.spill_over_fraction = friction::spill_over_fraction(film, stored.gap);
  const friction::TrappedLiquid liquid =
      friction::trapped_liquid(stored.contact, film, stored.gap, stored.grid, periodic);
  row.trapped_fraction = liquid.trapped_fraction;
  row.escaping_fraction = liquid.escaping_fraction;
}

void add_friction(const Study& study, Row& row) {
  const friction::Contact contact{row.mean_pressure, row.contact_area_fraction,
                                  row.contact_area_fraction_pixels, study.saturation_pressure,
                                  row.lubricated_share};
  const friction::Estimate estimate = friction::estimate(contact, study.shear_strength, study.area);
  analysis::add(analysis::of_friction(contact, estimate, row.spill_over_fraction), row.warnings);
  row.friction_dry = estimate.friction_dry;
  row.friction_lubricated = estimate.friction_lubricated;
}

void add_fluid(const Study& study, const StoredFluid& stored, Row& row) {
  const friction::MixedEstimate mixed =
      friction::estimate(stored.summary, row.mean_pressure, study.saturation_pressure,
                         study.shear_strength, study.area);
  row.fluid->load_share = stored.summary.load_share;
  row.fluid->contact_area_fraction = mixed.area_fraction;
  row.fluid->mean_gap = stored.summary.mean_gap;
  row.fluid->friction_solid = mixed.friction_solid;
  row.fluid->friction_viscous = mixed.friction_viscous;
  row.fluid->friction_mixed = mixed.friction_mixed;
  row.fluid->load_error = stored.summary.load_error;
  row.fluid->gap_error = stored.summary.gap_error;
  row.fluid->pressure_error = stored.summary.pressure_error;
  row.fluid->converged = stored.summary.converged;
  row.converged = row.converged && stored.summary.converged;
  analysis::add(analysis::of_flow(stored.doubts, mixed), row.warnings);
}

contact::Problem contact_problem(const Study& study, const topography::Topography& topography,
                                 double mean_pressure) {
  contact::Problem problem;
  problem.height = topography.height;
  problem.mean_pressure = mean_pressure;
  problem.saturation_pressure = study.saturation_pressure;
  problem.tolerance = study.contact.tolerance;
  return problem;
}

std::unique_ptr<elastic::ElasticOperator> operator_of(const Study& study, const Grid& grid) {
  return study.contact.periodic ? elastic::make_periodic(grid, study.effective_modulus())
                                : elastic::make_free(grid, study.effective_modulus());
}

contact::State solve_on(elastic::ElasticOperator& elasticity, const Study& study,
                        const contact::Problem& problem, const Observer& observer) {
  // A stopped solver returns what it has, which must not be stored as if it were a result.
  bool stopped = false;
  const Observer watching = [&](const Progress& progress) {
    stopped = stopped || (observer && !observer(progress));
    return !stopped;
  };
  contact::State state = contact::solve(elasticity, problem, study.contact.solver, watching);
  if (stopped) {
    throw Interrupted();
  }
  return state;
}

[[noreturn]] void refuse_replaced(const Scan& scan) {
  throw Error(scan.file.string() +
              ": replaced or changed while the sweep ran; nothing of it was kept, start the sweep "
              "again");
}

bool holds(const Scan& scan, const std::string& sha256) {
  try {
    return io::sha256_of_file(scan.file) == sha256;
  } catch (const InputError&) {
    return false;
  }
}

topography::Topography read_unchanged(const Scan& scan, const std::string& sha256,
                                      const Observer& observer) {
  try {
    const topography::ScanFile file(scan.file, observer);
    if (file.sha256() != sha256) refuse_replaced(scan);
    return file.read(scan.read);
  } catch (const InputError&) {  // of this scan, or of what took its place
    if (!holds(scan, sha256)) refuse_replaced(scan);
    throw;
  }
}

}  // namespace

topography::Topography treated_surface(const Study& study, const Scan& scan,
                                       const std::string& scan_sha256, const Observer& observer) {
  topography::Topography treated =
      topography::apply(study.treatment, read_unchanged(scan, scan_sha256, observer), observer);
  if (const Index n_holes = topography::count_holes(treated); n_holes > 0) {
    throw InputError(scan.label, fmt::format("{} missing pixels", n_holes),
                     "a surface without holes", "add \"fill=harmonic\" to treatment.steps");
  }
  return treated;
}

void compute_surface(const Store& store, const Unit& unit,
                     const topography::Topography& topography) {
  write_surface(store, unit, topography, topography::power_spectra(topography));
}

contact::State solve_contact(const Study& study, const topography::Topography& topography,
                             double mean_pressure, const Observer& observer) {
  return solve_on(*operator_of(study, topography.grid), study,
                  contact_problem(study, topography, mean_pressure), observer);
}

namespace {

analysis::Warnings warnings_of(const Study& study, const topography::Topography& topography,
                               const contact::State& state, const contact::Summary& summary) {
  const analysis::ContactSettings settings{.periodic = study.contact.periodic,
                                           .effective_modulus = study.effective_modulus(),
                                           .saturation_pressure = study.saturation_pressure};
  analysis::Warnings warnings = analysis::of_surface(topography);
  analysis::add(analysis::of_contact(topography, settings, state, summary), warnings);
  return warnings;
}

}  // namespace

void compute_contact(const Store& store, const Unit& unit, const Study& study,
                     const topography::Topography& topography, double mean_pressure,
                     const Observer& observer) {
  const Stopwatch watch;
  const Grid& grid = topography.grid;
  const auto elasticity = operator_of(study, grid);
  const contact::Problem problem = contact_problem(study, topography, mean_pressure);
  const contact::State state = solve_on(*elasticity, study, problem, observer);
  const contact::Summary summary = contact::summarise(state, problem, grid, study.contact.periodic);
  write_contact(store, unit, grid, problem, state, summary,
                {elasticity->fft_seconds(), watch.seconds()},
                warnings_of(study, topography, state, summary));
}

void compute_film(const Store& store, const Unit& unit, const Study& study,
                  const topography::Topography& topography, const Observer& observer) {
  const LubricantSettings& lubricant = study.lubricant;
  lubrication::Dose dose;
  for (const double density : study.lubricant_densities) {
    dose.mean_films.push_back(lubrication::mean_film(density, lubricant.oil_density));
  }
  dose.droplet_height = lubricant.droplet_height;
  dose.model = lubricant.model;
  dose.reading = lubricant.reading;
  dose.edge = lubricant.edge;
  dose.seed = lubricant.seed;
  FilmFile file(store, unit, topography.grid);
  const lubrication::FilmSink sink = [&](lubrication::Film&& film) {
    file.add(film, study.lubricant_densities[film.request], analysis::of_film(film));
  };
  lubrication::deposit(topography.height, topography.grid, dose, sink, observer);
  file.commit();
}

void compute_fluid(const Store& store, const Study& study, const topography::Topography& topography,
                   const contact::State& dry, const ScanUnits& units, std::size_t pressure,
                   std::size_t condition, const Observer& observer) {
  const Condition under = study.conditions().at(condition);
  friction::FluidFilmProblem problem;
  problem.contact = contact_problem(study, topography, study.mean_pressures[pressure]);
  problem.film = read_film(store, units.film, under.density);
  problem.sliding_speed = study.sliding_speeds[under.speed];
  problem.lubricant = friction::lubricant_of(study.lubricant.flowing.value());
  const auto elasticity = operator_of(study, topography.grid);
  const friction::FluidFilmState state =
      friction::solve_fluid_film(*elasticity, problem, dry, observer);
  const StoredFluid stored{friction::summarise(state, problem, topography.grid),
                           friction::doubts(state, problem)};
  write_fluid(
      store, units.fluids[pressure][condition], topography.grid, state, stored,
      {{"mean_pressure_Pa", problem.contact.mean_pressure},
       {"lubricant_density_g_per_m2", in_g_per_m2(study.lubricant_densities[under.density])},
       {"sliding_speed_m_per_s", problem.sliding_speed}});
}

void compute_row(const Store& store, const Study& study, const Scan& scan, const ScanUnits& units,
                 std::size_t pressure, std::size_t condition) {
  const StoredContact stored = read_contact(store, units.contacts[pressure]);
  const Condition under = study.conditions().at(condition);
  const Unit& unit = units.cases[pressure][condition];
  Row row = empty_row(study, scan, unit, pressure, under);
  add_contact(stored, row);
  add_liquid(stored, read_film(store, units.film, under.density), study.contact.periodic, row);
  analysis::add(read_film_warnings(store, units.film, under.density), row.warnings);
  add_friction(study, row);
  if (study.flows()) add_fluid(study, read_fluid(store, units.fluids[pressure][condition]), row);
  write_row(store, unit, row);
}

void record_failure(const Store& store, const Study& study, const Scan& scan,
                    const ScanUnits& units, std::size_t pressure, std::size_t condition,
                    const std::string& error) {
  const Unit& unit = units.cases[pressure][condition];
  Row row = empty_row(study, scan, unit, pressure, study.conditions().at(condition));
  row.error = error;
  write_row(store, unit, row);
}

}  // namespace tabor::study
