#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "tabor/cases/records.hpp"
#include "tabor/cases/settings.hpp"
#include "tabor/cases/tool.hpp"
#include "tabor/elastic/operator.hpp"
#include "tabor/topography/topography.hpp"

// Computes contact, film, flowing film and friction of a treated surface, in this order. Verbs,
// studies and programs call the same functions and get the same records. All throw InputError for
// invalid input and Interrupted where the observer asks to stop; not converging is returned.
namespace tabor::cases {

/// Makes the elastic half-space of the settings on a grid, for any number of contacts.
std::unique_ptr<elastic::ElasticOperator> make_operator(const ContactSettings& settings,
                                                        const Grid& grid);

/// Solves one contact of the surface under a mean pressure, a force or at a separation, with the
/// tool of the settings at its first place; the record has the warnings of both.
ContactRecord contact_state(elastic::ElasticOperator& elasticity,
                            const topography::Topography& surface, const ContactSettings& settings,
                            const contact::Control& control, const Observer& observer = {});
ContactRecord contact_state(const topography::Topography& surface, const ContactSettings& settings,
                            const contact::Control& control, const Observer& observer = {});

/// What presses on a surface, and what the contacts of a load path have left of it so far.
struct Pressing {
  /// Heights of the surface and of the tool, unloaded [m]; empty for the surface as it is under a
  /// flat.
  Field height = {};
  std::optional<ToolPlace> place = {};     ///< absent for a flat
  std::shared_ptr<const Field> tool = {};  ///< its heights over the surface [m]; null: a flat
  Warnings warnings = {};                  ///< of pressing with it

  /// Returns the height that the next contact is solved on [m].
  const Field& height_of(const topography::Topography& surface) const {
    return height.size() > 0 ? height : surface.height;
  }
};
/// Puts a tool over the surface at a place [pixels].
Pressing pressing(const topography::Topography& surface, const Tool& tool, Index place);

/// Solves the next contact: of a load path on the surface that the contacts before it have left,
/// else on the surface as it is.
ContactRecord contact_state(elastic::ElasticOperator& elasticity,
                            const topography::Topography& surface, const ContactSettings& settings,
                            const contact::Control& control, Pressing& pressing,
                            const Observer& observer = {});

/// Solves the contacts of all controls, one after the other; hands each record on and then drops
/// it. Along a load path, each contact is on the surface that the one before has left.
void contact_states(elastic::ElasticOperator& elasticity, const topography::Topography& surface,
                    const ContactSettings& settings, const std::vector<contact::Control>& controls,
                    const std::function<void(ContactRecord&&)>& receive,
                    const Observer& observer = {});

/// Returns the dose of a rain on the surface with these settings.
deposition::Dose dose_of(const FilmSettings& settings, const topography::Topography& surface);

/// Returns a sink that makes records of the films of a surface and hands them on. All it is given
/// must outlive it.
deposition::FilmSink film_sink(const topography::Topography& surface, const FilmSettings& settings,
                               const std::function<void(FilmRecord&&)>& receive);
/// Lays down the films of all densities in one rain, in rising order of density; `receive` gets
/// each when it is complete, so that only one is in memory.
void film_state(const topography::Topography& surface, const FilmSettings& settings,
                const std::function<void(FilmRecord&&)>& receive, const Observer& observer = {});
/// Returns the films of all densities in the order of the settings.
std::vector<FilmRecord> film_state(const topography::Topography& surface,
                                   const FilmSettings& settings, const Observer& observer = {});

/// Returns the height that a contact was solved on: the surface and, where there is one, the tool.
Field pressed_height(const topography::Topography& surface, const ContactRecord& contact);

/// Computes a film [m] whose closed pockets carry load in a contact of this height [m]; `dry`: its
/// state without oil.
TrappedRecord trapped_state(elastic::ElasticOperator& elasticity, const Field& height,
                            const contact::State& dry, const Field& film,
                            const CaseSettings& settings, const Observer& observer = {});

/// Computes the same from records, which must be of this surface.
TrappedRecord trapped_state(elastic::ElasticOperator& elasticity,
                            const topography::Topography& surface, const ContactRecord& dry,
                            const FilmRecord& film, const CaseSettings& settings,
                            const Observer& observer = {});

/// Computes the flow of a film [m] between the surfaces of `dry`, a contact of this height [m]
/// under this mean pressure [Pa].
FluidRecord fluid_state(elastic::ElasticOperator& elasticity, const Field& height,
                        const contact::State& dry, double mean_pressure, const Field& film,
                        const ContactSettings& contact, const FluidSettings& settings,
                        const Observer& observer = {});

/// Computes the same flow from records, which must be of this surface.
FluidRecord fluid_state(elastic::ElasticOperator& elasticity, const topography::Topography& surface,
                        const ContactRecord& dry, const FilmRecord& film,
                        const ContactSettings& contact, const FluidSettings& settings,
                        const Observer& observer = {});

/// Contact mask and gap of a closed contact; maps of one shape.
struct Closed {
  const Mask& contact;
  const Field& gap;  ///< [m]
  const Grid& grid;
};

/// Computes the friction of a contact with the oil in it, all on one surface.
FrictionRecord friction_state(const ContactRecord& contact, const Closed& closed, const Oil& oil,
                              const ContactSettings& contact_settings,
                              const FrictionSettings& settings);

/// Computes the friction of a contact whose trapped oil carries part of the load: that of its dry
/// and of its wet solids, mu = tau_y A_dry/(A0 P) + tau_b A_wet/(A0 P).
TrappedFriction trapped_friction(const TrappedRecord& trapped, double mean_pressure,
                                 const ContactSettings& contact, const FrictionSettings& settings);

/// Returns the means over the places of a tool, with their standard deviations and the warnings of
/// all; the record itself where there is one.
FrictionRecord mean_over_places(const std::vector<FrictionRecord>& records);

/// Estimates the friction of the solids, of which liquid covers a share.
friction::Estimate estimate_of(const contact::Summary& contact, double lubricated_share,
                               const ContactSettings& contact_settings,
                               const FrictionSettings& settings);

/// Estimates the friction of the solids and adds its warnings to a list.
friction::Estimate dry_friction(const ContactRecord& contact, double lubricated_share,
                                double spill_over_fraction, const ContactSettings& contact_settings,
                                const FrictionSettings& settings, Warnings& warnings);

/// Returns what to cite, as keys of references.bib.
std::vector<std::string> references_of(const ContactSettings& settings);
std::vector<std::string> references_of(const FilmSettings& settings);
std::vector<std::string> references_of(const TrappedSettings& settings);
std::vector<std::string> references_of(const FluidSettings& settings);
std::vector<std::string> references_of(const FrictionSettings& settings);
std::vector<std::string> references_of(const CaseSettings& settings);

/// Appends the keys that are not in the list yet.
void add(const std::vector<std::string>& more, std::vector<std::string>& references);

}  // namespace tabor::cases
