#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "tabor/analysis/records.hpp"
#include "tabor/analysis/settings.hpp"
#include "tabor/elastic/operator.hpp"
#include "tabor/topography/topography.hpp"

// The way from a treated surface to its friction: contact, film, film that flows, friction. Verbs,
// studies and programs call the same functions and get the same records. All throw InputError for
// what is invalid and Interrupted where the observer asks to stop; not converging is returned.
namespace tabor::analysis {

/// The elastic half-space of the settings on a grid, for any number of contacts.
std::unique_ptr<elastic::ElasticOperator> make_operator(const ContactSettings& settings,
                                                        const Grid& grid);

/// One contact of the surface under a mean pressure [Pa], with the warnings of both.
ContactRecord contact_state(elastic::ElasticOperator& elasticity,
                            const topography::Topography& surface, const ContactSettings& settings,
                            double mean_pressure, const Observer& observer = {});
ContactRecord contact_state(const topography::Topography& surface, const ContactSettings& settings,
                            double mean_pressure, const Observer& observer = {});

/// The surface as the contacts of a load path have left it so far.
struct LoadPath {
  Field height;  ///< unloaded [m]; empty before the first contact
};

/// The next contact of a load path, on the surface that those before it have left. Where the
/// settings ask for no load path, that of the surface as it is.
ContactRecord contact_state(elastic::ElasticOperator& elasticity,
                            const topography::Topography& surface, const ContactSettings& settings,
                            double mean_pressure, LoadPath& path, const Observer& observer = {});

/// All pressures, one after the other, each record handed on and then dropped: along a load path
/// on the surface that the contact before has left.
void contact_states(elastic::ElasticOperator& elasticity, const topography::Topography& surface,
                    const ContactSettings& settings, const std::vector<double>& mean_pressures,
                    const std::function<void(ContactRecord&&)>& receive,
                    const Observer& observer = {});

/// What the settings ask of a rain.
deposition::Dose dose_of(const FilmSettings& settings);

/// The films of all densities from one rain, in rising order of density; `receive` gets each when
/// it is there, so that only one is in memory.
void film_state(const topography::Topography& surface, const FilmSettings& settings,
                const std::function<void(FilmRecord&&)>& receive, const Observer& observer = {});
/// The same in the order of the settings.
std::vector<FilmRecord> film_state(const topography::Topography& surface,
                                   const FilmSettings& settings, const Observer& observer = {});

/// What a film [m] does that flows between the surfaces of `dry`, a contact of this height [m]
/// under this mean pressure [Pa].
FluidRecord fluid_state(elastic::ElasticOperator& elasticity, const Field& height,
                        const contact::State& dry, double mean_pressure, const Field& film,
                        const ContactSettings& contact, const FluidSettings& settings,
                        const Observer& observer = {});

/// Where solids touch and what room they leave; maps of one shape.
struct Closed {
  const Mask& contact;
  const Field& gap;  ///< [m]
  const Grid& grid;
};

/// Friction of a contact with a film, and with what it does where it flows (else null).
FrictionRecord friction_state(const ContactRecord& contact, const Closed& closed,
                              const FilmRecord& film, const FluidRecord* fluid,
                              const ContactSettings& contact_settings,
                              const FrictionSettings& settings);

/// Friction of the solids, of which liquid covers a share.
friction::Estimate estimate_of(const contact::Summary& contact, double lubricated_share,
                               const ContactSettings& contact_settings,
                               const FrictionSettings& settings);

/// The same with its warnings added to a list.
friction::Estimate dry_friction(const ContactRecord& contact, double lubricated_share,
                                double spill_over_fraction, const ContactSettings& contact_settings,
                                const FrictionSettings& settings, Warnings& warnings);

/// What to cite, as keys of references.bib.
std::vector<std::string> references_of(const ContactSettings& settings);
std::vector<std::string> references_of(const FilmSettings& settings);
std::vector<std::string> references_of(const FluidSettings& settings);
std::vector<std::string> references_of(const FrictionSettings& settings);
std::vector<std::string> references_of(const CaseSettings& settings);

/// Appends the keys that are not in the list yet.
void add(const std::vector<std::string>& more, std::vector<std::string>& references);

}  // namespace tabor::analysis
