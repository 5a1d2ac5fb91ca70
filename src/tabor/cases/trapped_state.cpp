#include <utility>

#include "tabor/cases/belonging.hpp"
#include "tabor/cases/states.hpp"
#include "tabor/cases/warnings.hpp"
#include "tabor/core/loops.hpp"
#include "tabor/friction/wet_contact.hpp"

namespace tabor::cases {
namespace {

/// Pressure where the solids touch, 0 elsewhere [Pa].
Field solid_pressure(const contact::TrappedState& state, const Mask& touching) {
  const Field& pressure = state.contact.pressure;
  Field solid(pressure.rows(), pressure.cols());
  for_each(solid.size(), [&](Index i) { solid(i) = touching(i) ? pressure(i) : 0; });
  return solid;
}

/// Summarises the contact of the solids alone; the state is as before afterwards.
contact::Summary summary_of_solids(contact::TrappedState& state, const Mask& touching,
                                   const contact::Problem& problem, const Grid& grid,
                                   bool periodic) {
  contact::State& all = state.contact;
  Field pressure = solid_pressure(state, touching);
  const double mean = sum(pressure) / static_cast<double>(pressure.size());
  std::swap(all.pressure, pressure);
  const double mean_of_all = std::exchange(all.mean_pressure, mean);
  const contact::Summary summary = contact::summarise(all, problem, grid, periodic);
  std::swap(all.pressure, pressure);
  all.mean_pressure = mean_of_all;
  return summary;
}

}  // namespace

Field pressed_height(const topography::Topography& surface, const ContactRecord& contact) {
  if (contact.tool == nullptr) return surface.height;
  return surface.height + *contact.tool;
}

TrappedRecord trapped_state(elastic::ElasticOperator& elasticity, const Field& height,
                            const contact::State& dry, const Field& film,
                            const CaseSettings& settings, const Observer& observer) {
  const ContactSettings& contact = settings.contact;
  const contact::Problem problem{.height = height,
                                 .control = contact::MeanPressure{dry.mean_pressure},
                                 .bounds = {.upper = contact.pressure_cap()},
                                 .tolerance = contact.tolerance};
  TrappedRecord record;
  record.state = contact::solve_trapped(elasticity, problem,
                                        {.film = film,
                                         .bulk_modulus = settings.trapped.bulk_modulus,
                                         .periodic = contact.is_periodic()},
                                        dry, observer);
  record.convergence = record.state.contact.convergence;
  throw_if_stopped(record.convergence);
  const Mask touching = contact::solid_contact(record.state);
  record.solids =
      summary_of_solids(record.state, touching, problem, elasticity.grid(), contact.is_periodic());
  record.liquid = record.state.liquid;
  record.lubricated_share = friction::lubricated_share(touching, film, settings.friction.dry_below);
  record.mean_gap = record.solids.mean_gap;
  record.references = references_of(settings.trapped);
  record.warnings = of_trapped(record);
  return record;
}

TrappedRecord trapped_state(elastic::ElasticOperator& elasticity,
                            const topography::Topography& surface, const ContactRecord& dry,
                            const FilmRecord& film, const CaseSettings& settings,
                            const Observer& observer) {
  require_contact_of(surface, dry.surface);
  require_one_surface(dry, film);
  TrappedRecord record = trapped_state(elasticity, pressed_height(surface, dry), dry.state,
                                       film.film.thickness, settings, observer);
  record.surface = dry.surface;
  return record;
}

}  // namespace tabor::cases
