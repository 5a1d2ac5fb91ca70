#include "tabor/study/compute.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "tabor/core/error.hpp"
#include "tabor/core/resources.hpp"
#include "tabor/elastic/half_space.hpp"
#include "tabor/friction/trapped.hpp"
#include "tabor/friction/wet_contact.hpp"

namespace tabor::study {
namespace {

/// A row that has its place and no numbers yet.
Row empty_row(const Study& study, const Scan& scan, const Unit& unit, std::size_t pressure,
              std::size_t density) {
  Row row;
  row.case_id = unit.key;
  row.scan = scan.label;
  row.group = scan.group;
  row.mean_pressure = study.mean_pressures[pressure];
  row.lubricant_density = study.lubricant_densities[density];
  return row;
}

void add_contact(const StoredContact& stored, Row& row) {
  row.contact_area_fraction = stored.summary.contact_area_fraction;
  row.contact_area_fraction_pixels = stored.summary.contact_area_fraction_pixels;
  row.saturated_area_fraction = stored.summary.saturated_area_fraction;
  row.mean_gap = stored.summary.mean_gap;
  row.certificate = stored.convergence.certificate;
  row.converged = stored.convergence.converged;
}

void add_liquid(const StoredContact& stored, const Field& film, bool periodic, Row& row) {
  row.lubricated_share = friction::lubricated_share(stored.contact, film);
  row.spill_over_fraction = friction::spill_over_fraction(film, stored.gap);
  const friction::TrappedLiquid liquid =
      friction::trapped_liquid(stored.contact, film, stored.gap, stored.grid, periodic);
  row.trapped_fraction = liquid.trapped_fraction;
  row.escaping_fraction = liquid.escaping_fraction;
}

void add_friction(const Study& study, Row& row) {
  const friction::Estimate estimate = friction::estimate(
      {row.mean_pressure, row.contact_area_fraction, row.contact_area_fraction_pixels,
       study.saturation_pressure, row.lubricated_share},
      study.shear_strength, study.area);
  row.friction_dry = estimate.friction_dry;
  row.friction_lubricated = estimate.friction_lubricated;
}

}  // namespace

topography::Topography treated_surface(const Study& study, const Scan& scan,
                                       const Observer& observer) {
  topography::Topography treated = topography::apply(
      study.treatment, topography::read(scan.file, scan.read, observer), observer);
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

void compute_contact(const Store& store, const Unit& unit, const Study& study,
                     const topography::Topography& topography, double mean_pressure,
                     const Observer& observer) {
  const Stopwatch watch;
  const Grid& grid = topography.grid;
  const bool periodic = study.contact.periodic;
  const auto elasticity = periodic ? elastic::make_periodic(grid, study.effective_modulus())
                                   : elastic::make_free(grid, study.effective_modulus());
  contact::Problem problem;
  problem.height = topography.height;
  problem.mean_pressure = mean_pressure;
  problem.saturation_pressure = study.saturation_pressure;
  problem.tolerance = study.contact.tolerance;
  // A stopped solver returns what it has, which must not be stored as if it were a result.
  bool stopped = false;
  const Observer watching = [&](const Progress& progress) {
    stopped = stopped || (observer && !observer(progress));
    return !stopped;
  };
  const contact::State state = contact::solve(*elasticity, problem, study.contact.solver, watching);
  if (stopped) {
    throw Interrupted();
  }
  const contact::Summary summary = contact::summarise(state, problem, grid, periodic);
  write_contact(store, unit, grid, problem, state, summary,
                {elasticity->fft_seconds(), watch.seconds()});
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
    file.add(film, study.lubricant_densities[film.request]);
  };
  lubrication::deposit(topography.height, topography.grid, dose, sink, observer);
  file.commit();
}

void compute_rows(const Store& store, const Study& study, const Scan& scan, const ScanUnits& units,
                  std::size_t pressure) {
  const StoredContact stored = read_contact(store, units.contacts[pressure]);
  for (std::size_t density = 0; density < study.lubricant_densities.size(); ++density) {
    const Unit& unit = units.cases[pressure][density];
    Row row = empty_row(study, scan, unit, pressure, density);
    add_contact(stored, row);
    add_liquid(stored, read_film(store, units.film, density), study.contact.periodic, row);
    add_friction(study, row);
    write_row(store, unit, row);
  }
}

void record_failure(const Store& store, const Study& study, const Scan& scan,
                    const ScanUnits& units, std::size_t pressure, const std::string& error) {
  for (std::size_t density = 0; density < study.lubricant_densities.size(); ++density) {
    const Unit& unit = units.cases[pressure][density];
    Row row = empty_row(study, scan, unit, pressure, density);
    row.error = error;
    write_row(store, unit, row);
  }
}

}  // namespace tabor::study
