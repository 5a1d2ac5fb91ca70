#include <algorithm>

#include "tabor/cases/belonging.hpp"
#include "tabor/cases/states.hpp"
#include "tabor/cases/warnings.hpp"
#include "tabor/friction/trapped.hpp"
#include "tabor/friction/wet_contact.hpp"

namespace tabor::cases {
namespace {

FrictionRecord numbers_of(const ContactRecord& contact, const FilmRecord& film) {
  FrictionRecord record;
  record.mean_pressure = contact.summary.mean_pressure;
  record.lubricant_density = film.lubricant_density;
  record.contact_area_fraction = contact.summary.contact_area_fraction;
  record.contact_area_fraction_pixels = contact.summary.contact_area_fraction_pixels;
  record.saturated_area_fraction = contact.summary.saturated_area_fraction;
  record.mean_gap = contact.summary.mean_gap;
  record.separation = contact.summary.separation;
  record.mean_film = film.mean_film_left();
  record.certificate = contact.convergence.certificate;
  record.contact_gap_error = contact.summary.contact_gap_error;
  record.converged = contact.convergence.converged();
  if (contact.tool_place) record.tool = ToolFriction{.place = contact.tool_place};
  record.warnings = contact.warnings;
  add(film.warnings, record.warnings);
  record.references = contact.references;
  add(film.references, record.references);
  return record;
}

/// Where the liquid is when the surfaces are closed.
void add_liquid(const Closed& closed, const Field& film, bool periodic, double dry_below,
                FrictionRecord& record) {
  record.lubricated_share = friction::lubricated_share(closed.contact, film, dry_below);
  record.spill_over_fraction = friction::spill_over_fraction(film, closed.gap);
  const friction::TrappedLiquid liquid =
      friction::trapped_liquid(closed.contact, film, closed.gap, closed.grid, periodic);
  record.trapped_fraction = liquid.trapped_fraction;
  record.escaping_fraction = liquid.escaping_fraction;
}

}  // namespace

TrappedFriction trapped_friction(const TrappedRecord& trapped, double mean_pressure,
                                 const ContactSettings& contact, const FrictionSettings& settings) {
  const contact::LiquidSummary& liquid = trapped.liquid;
  TrappedFriction friction{.load_share = liquid.load_share,
                           .max_pressure = liquid.max_pressure,
                           .n_pockets = liquid.n_pockets,
                           .n_squeezed = liquid.n_squeezed,
                           .n_at_seal = liquid.n_at_seal,
                           .leaked_fraction = liquid.leaked_fraction,
                           .contact_area_fraction = 0,
                           .lubricated_share = trapped.lubricated_share,
                           .mean_gap = trapped.solids.mean_gap,
                           .friction_solid = 0,
                           .friction_boundary = 0,
                           .certificate = trapped.convergence.certificate,
                           .converged = trapped.converged()};
  if (!(trapped.solids.mean_pressure > 0)) return friction;
  const friction::Estimate solids =
      estimate_of(trapped.solids, trapped.lubricated_share, contact, settings);
  const double carried = trapped.solids.mean_pressure / mean_pressure;
  const double wet = trapped.lubricated_share * settings.boundary_strength();
  friction.contact_area_fraction = solids.area_fraction;
  friction.friction_solid = carried * solids.friction_dry * (1 - trapped.lubricated_share);
  friction.friction_boundary = carried * solids.friction_dry * wet / settings.shear_strength;
  return friction;
}

namespace {

void add_trapped(const TrappedRecord& trapped, const ContactSettings& contact,
                 const FrictionSettings& settings, FrictionRecord& record) {
  record.trapped = trapped_friction(trapped, record.mean_pressure, contact, settings);
  record.friction_lubricated = record.trapped->friction_solid + record.trapped->friction_boundary;
  record.converged = record.converged && record.trapped->converged;
  add(trapped.warnings, record.warnings);
  add(trapped.references, record.references);
}

void add_flow(const FluidRecord& fluid, const friction::MixedEstimate& mixed,
              FrictionRecord& record) {
  const friction::FluidSummary& summary = fluid.summary;
  record.fluid = FlowingFriction{.sliding_speed = fluid.sliding_speed,
                                 .load_share = summary.load_share,
                                 .max_pressure = summary.max_pressure,
                                 .contact_area_fraction = mixed.area_fraction,
                                 .mean_gap = summary.mean_gap,
                                 .full_fraction = summary.full_fraction,
                                 .outside_film = summary.outside_film,
                                 .friction_solid = mixed.friction_solid,
                                 .friction_viscous = mixed.friction_viscous,
                                 .friction_mixed = mixed.friction_mixed,
                                 .load_error = summary.load_error,
                                 .gap_error = summary.gap_error,
                                 .pressure_error = summary.pressure_error,
                                 .evaluations = summary.convergence.iterations,
                                 .iterations = summary.film_iterations,
                                 .converged = summary.convergence.converged()};
  record.converged = record.converged && record.fluid->converged;
  add(fluid.warnings, record.warnings);
  add(fluid.references, record.references);
  add(of_mixed_friction(mixed), record.warnings);
}

friction::Contact touching_of(const contact::Summary& contact, double lubricated_share,
                              const ContactSettings& settings) {
  return {.mean_pressure = contact.mean_pressure,
          .contact_area_fraction = contact.contact_area_fraction,
          .contact_area_fraction_pixels = contact.contact_area_fraction_pixels,
          .saturation_pressure = settings.pressure_cap(),
          .lubricated_share = lubricated_share};
}

}  // namespace

friction::Estimate estimate_of(const contact::Summary& contact, double lubricated_share,
                               const ContactSettings& contact_settings,
                               const FrictionSettings& settings) {
  return friction::estimate(touching_of(contact, lubricated_share, contact_settings),
                            settings.shear_strength, settings.area_of(contact_settings),
                            settings.boundary_strength());
}

friction::Estimate dry_friction(const ContactRecord& contact, double lubricated_share,
                                double spill_over_fraction, const ContactSettings& contact_settings,
                                const FrictionSettings& settings, Warnings& warnings) {
  const friction::Estimate estimate =
      estimate_of(contact.summary, lubricated_share, contact_settings, settings);
  const Warnings own = of_friction(touching_of(contact.summary, lubricated_share, contact_settings),
                                   estimate, spill_over_fraction, settings);
  std::erase_if(warnings, [&](const Warning& of_contact) {  // said of friction
    return std::any_of(own.begin(), own.end(),
                       [&](const Warning& one) { return one.code == of_contact.code; });
  });
  add(own, warnings);
  return estimate;
}

FrictionRecord friction_state(const ContactRecord& contact, const Closed& closed, const Oil& oil,
                              const ContactSettings& contact_settings,
                              const FrictionSettings& settings) {
  require_one_surface(contact, oil.film, oil.fluid, oil.trapped);
  FrictionRecord record = numbers_of(contact, oil.film);
  add_liquid(closed, oil.film.film.thickness, contact_settings.is_periodic(), settings.dry_below,
             record);
  const friction::Estimate estimate =
      dry_friction(contact, record.lubricated_share,
                   oil.trapped == nullptr ? record.spill_over_fraction : 0,  // it is accounted for
                   contact_settings, settings, record.warnings);
  add(of_film_in_gap(record.mean_film, record.mean_gap), record.warnings);
  add(references_of(settings), record.references);
  record.area = estimate.area;
  record.boundary_shear_strength = settings.boundary_strength();
  record.friction_area_fraction = estimate.area_fraction;
  record.dry_at_bound = estimate.at_bound;
  record.friction_dry = estimate.friction_dry;
  record.friction_lubricated = estimate.friction_lubricated;
  if (oil.trapped != nullptr) add_trapped(*oil.trapped, contact_settings, settings, record);
  if (oil.fluid != nullptr) {
    add_flow(*oil.fluid,
             friction::estimate(oil.fluid->summary, record.mean_pressure,
                                contact_settings.pressure_cap(), settings.shear_strength,
                                settings.area_of(contact_settings), settings.boundary_strength()),
             record);
  }
  return record;
}

}  // namespace tabor::cases
