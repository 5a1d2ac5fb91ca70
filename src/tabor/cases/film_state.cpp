#include <fmt/format.h>

#include <utility>

#include "tabor/cases/belonging.hpp"
#include "tabor/cases/states.hpp"
#include "tabor/cases/warnings.hpp"
#include "tabor/core/checks.hpp"
#include "tabor/core/resources.hpp"
#include "tabor/core/watch.hpp"
#include "tabor/topography/digest.hpp"

namespace tabor::cases {
namespace {

FilmRecord record_of(const topography::Topography& surface, std::uint64_t digest,
                     deposition::Film&& film, const FilmSettings& settings) {
  FilmRecord record{.surface = digest,
                    .lubricant_density = settings.lubricant_densities[film.request],
                    .film = {},
                    .peak_memory = peak_memory_bytes(),
                    .warnings = of_film(surface, film),
                    .references = references_of(settings)};
  record.film = std::move(film);
  return record;
}

}  // namespace

deposition::Dose dose_of(const FilmSettings& settings, const topography::Topography& surface) {
  deposition::Dose dose;
  for (const double density : settings.lubricant_densities) {
    dose.mean_films.push_back(deposition::mean_film(density, settings.oil_density));
  }
  dose.droplet_height = settings.droplet_height;
  dose.model = settings.model;
  dose.reading = settings.reading;
  dose.edge = settings.edge;
  dose.seed = settings.seed;
  dose.mirrored = surface.tiles > 1;
  return dose;
}

deposition::FilmSink film_sink(const topography::Topography& surface, const FilmSettings& settings,
                               const std::function<void(FilmRecord&&)>& receive) {
  const Grid& grid = surface.grid;
  constexpr double kBytesOfPixel = 16;  // that rain takes at least, beside the heights
  check_memory("surface to lubricate", fmt::format("{} x {} pixels", grid.nx, grid.ny),
               kBytesOfPixel * static_cast<double>(grid.size()), "crop or resample the surface");
  const std::uint64_t digest = topography::digest_of(surface.height, surface.grid);
  return [&surface, &settings, &receive, digest](deposition::Film&& film) {
    receive(record_of(surface, digest, std::move(film), settings));
  };
}

void film_state(const topography::Topography& surface, const FilmSettings& settings,
                const std::function<void(FilmRecord&&)>& receive, const Observer& observer) {
  deposition::deposit(surface.height, surface.grid, dose_of(settings, surface),
                      film_sink(surface, settings, receive), observer);
}

std::vector<FilmRecord> film_state(const topography::Topography& surface,
                                   const FilmSettings& settings, const Observer& observer) {
  std::vector<FilmRecord> films(settings.lubricant_densities.size());
  const auto receive = [&films](FilmRecord&& record) {
    films[record.film.request] = std::move(record);
  };
  film_state(surface, settings, receive, observer);
  return films;
}

FluidRecord fluid_state(elastic::ElasticOperator& elasticity, const Field& height,
                        const contact::State& dry, double mean_pressure, const Field& film,
                        const ContactSettings& contact, const FluidSettings& settings,
                        const Observer& observer) {
  friction::FluidFilmProblem problem;
  problem.contact.height = height;
  problem.contact.control = contact::MeanPressure{mean_pressure};
  problem.contact.bounds.upper = contact.pressure_cap();
  problem.contact.tolerance = contact.tolerance;
  problem.film = film;
  problem.sliding_speed = settings.sliding_speed.value_or(0);
  problem.lubricant = friction::lubricant_of(settings.oil());
  FluidRecord record;
  record.state = friction::solve_fluid_film(elasticity, problem, dry, observer);
  throw_if_stopped(record.state.convergence);
  record.summary = friction::summarise(record.state, problem, elasticity.grid());
  record.sliding_speed = problem.sliding_speed;
  record.references = references_of(settings);
  record.warnings = friction::warnings(record.state, problem);
  return record;
}

FluidRecord fluid_state(elastic::ElasticOperator& elasticity, const topography::Topography& surface,
                        const ContactRecord& dry, const FilmRecord& film,
                        const ContactSettings& contact, const FluidSettings& settings,
                        const Observer& observer) {
  require_contact_of(surface, dry.surface);
  require_one_surface(dry, film);
  FluidRecord record = fluid_state(elasticity, surface.height, dry.state, dry.summary.mean_pressure,
                                   film.film.thickness, contact, settings, observer);
  record.surface = dry.surface;
  return record;
}

}  // namespace tabor::cases
