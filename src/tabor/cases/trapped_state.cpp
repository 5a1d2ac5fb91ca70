#include <utility>

#include "tabor/cases/belonging.hpp"
#include "tabor/cases/states.hpp"
#include "tabor/cases/warnings.hpp"
#include "tabor/friction/wet_contact.hpp"

namespace tabor::cases {
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
  record.solids =
      contact::summarise_solids(record.state, problem, elasticity.grid(), contact.is_periodic());
  record.liquid = record.state.liquid;
  record.lubricated_share = friction::lubricated_share(contact::solid_contact(record.state), film,
                                                       settings.friction.dry_below);
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
