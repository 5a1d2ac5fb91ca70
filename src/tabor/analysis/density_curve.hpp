#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tabor/analysis/plateau.hpp"
#include "tabor/analysis/records.hpp"
#include "tabor/analysis/settings.hpp"
#include "tabor/topography/topography.hpp"

// How friction depends on the areal density of the lubricant: flat between the dose that fills the
// pockets under the contacts and the one whose level reaches the contacts from the valleys.
namespace tabor::analysis {

/// Friction of one contact against the density, lists of one length.
struct DensityCurve {
  double mean_pressure = 0;  ///< [Pa]
  double friction_dry = 0;
  std::vector<double> lubricant_densities;  ///< [kg/m^2], rising, ten a decade
  std::vector<double> lubricated_shares;
  std::vector<double> friction_lubricated;
  std::optional<Plateau>
      plateau;  ///< densities [kg/m^2] over which the dry share hardly changes, and that
};

/// Which of many doses is the first to wet each pixel of a surface.
struct WettingDoses {
  /// [kg/m^2], rising, ten a decade from 0.001 g/m^2 to 10 g/m^2 or to what drowns the surface;
  /// none for a surface without heights.
  std::vector<double> lubricant_densities;
  std::vector<std::uint8_t>
      first;  ///< per pixel, row by row: its place; their number where none is
};

/// Whether there is oil that runs downhill, so that it fills pockets first and then valleys, and
/// does not flow on.
bool has_density_curve(const CaseSettings& settings);

/// Of the pixels of `where`, in the shape of the surface; the others count as wet by none. All
/// doses are reached in one pass of vanishing droplets (Model::limit), whatever model the settings
/// ask for. Throws as density_curves().
WettingDoses wetting_doses(const topography::Topography& surface, const FilmSettings& settings,
                           const Mask& where, const Observer& observer = {});

/// Of all pixels: needs no contact, and serves any.
WettingDoses wetting_doses(const topography::Topography& surface, const FilmSettings& settings,
                           const Observer& observer = {});

/// The share of a contact that each of the doses wets; 0 where nothing touches.
std::vector<double> lubricated_shares(const WettingDoses& doses, const Mask& contact);

/// The friction of one contact whose wet share is known for rising densities [kg/m^2].
DensityCurve density_curve(const std::vector<double>& lubricant_densities,
                           const std::vector<double>& lubricated_shares,
                           const contact::Summary& contact, const CaseSettings& settings);

/// The densities over which the dry share of its contact hardly changes, and that share; none where
/// it changes throughout or all is drowned.
std::optional<Plateau> plateau_of(const DensityCurve& curve);

/// A solved contact: its numbers and where solids touch, in the shape of the surface.
struct Touching {
  contact::Summary summary;
  Mask mask;
};

/// One curve for each contact with the surface. Empty for a surface without heights. Throws
/// InputError for invalid settings, Interrupted where the observer asks to stop.
std::vector<DensityCurve> density_curves(const topography::Topography& surface,
                                         const std::vector<Touching>& contacts,
                                         const CaseSettings& settings,
                                         const Observer& observer = {});
/// The same where it is known which dose wets which pixel.
std::vector<DensityCurve> density_curves(const WettingDoses& doses,
                                         const std::vector<Touching>& contacts,
                                         const CaseSettings& settings);

/// In one sentence, what the curve says of the densities [kg/m^2] that were asked for: "the pockets
/// under the contacts are full from 0.05 g/m^2 (16 % of the contact is wet); ...".
std::string sentence_of(const DensityCurve& curve, const std::vector<double>& asked);

}  // namespace tabor::analysis
