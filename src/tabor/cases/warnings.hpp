#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tabor/cases/records.hpp"
#include "tabor/cases/settings.hpp"
#include "tabor/cases/warning.hpp"
#include "tabor/contact/contact.hpp"
#include "tabor/contact/stiffness.hpp"
#include "tabor/deposition/deposition.hpp"
#include "tabor/friction/bowden_tabor.hpp"
#include "tabor/friction/mixed_friction.hpp"
#include "tabor/metrology/spectra/psd.hpp"
#include "tabor/topography/topography.hpp"

// What a user must be told about each number. Verbs and studies ask the same functions, so that a
// number comes with the same warnings wherever it appears; docs/warnings.md says what to do.
namespace tabor::cases {

/// A surface that does not tile and is used as it was read: by how much a plane would change it.
std::optional<Warning> not_levelled(const topography::Topography& surface);

/// Warnings about a treated surface, whatever is computed with it.
Warnings of_surface(const topography::Topography& surface);

/// Returns the warnings of a surface, then those of a result on it that are not among them.
Warnings joined(Warnings of_surface, const Warnings& of_result);

/// Warns of exponents more than their error outside 0 to 1.
Warnings of_spectra(const metrology::PowerSpectra& spectra);

/// Warns of one solved contact on the treated surface.
Warnings of_contact(const topography::Topography& surface, const ContactSettings& settings,
                    const contact::State& state, const contact::Summary& summary);

/// Warns of its stiffness.
Warnings of_stiffness(const contact::Stiffness& stiffness);

/// Warns of one film as it was laid down on a treated surface.
Warnings of_film(const topography::Topography& surface, const deposition::Film& film);

/// Warns of the friction of one contact with one film; `spill_over_fraction` of the liquid does not
/// fit.
Warnings of_friction(const friction::Contact& contact, const friction::Estimate& estimate,
                     double spill_over_fraction, const FrictionSettings& settings);

/// Warns of a film that is thicker than the gap on average [m].
Warnings of_film_in_gap(double mean_film, double mean_gap);

/// Warns of a wet share that pixels twice as large [m] change by more than a fifth.
Warnings of_pixel(double coarse_pixel, double coarse_share, double pixel, double share);

/// Warns of trapped oil: not converged, and what leaks out of pockets.
Warnings of_trapped(const TrappedRecord& trapped);

/// Warns of the friction of solids and oil together.
Warnings of_mixed_friction(const friction::MixedEstimate& mixed);

}  // namespace tabor::cases
