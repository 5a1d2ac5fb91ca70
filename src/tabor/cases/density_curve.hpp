#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "tabor/cases/plateau.hpp"
#include "tabor/cases/records.hpp"
#include "tabor/cases/settings.hpp"
#include "tabor/topography/topography.hpp"

// Computes friction against the areal density of the lubricant. The curve is flat between the dose
// that fills the depressions under the contacts and the dose whose level reaches the contacts. It
// is that of vanishing droplets (Model::limit), whatever model lays down the films;
// results/density_answer.hpp interprets it.
namespace tabor::cases {

/// Friction of one contact against the density; all lists have one length.
struct DensityCurve {
  double mean_pressure = 0;  ///< [Pa]
  double friction_dry = 0;
  std::vector<double> lubricant_densities;  ///< [kg/m^2], rising in steps of at most 5 %
  std::vector<double> lubricated_shares;
  std::vector<double> friction_lubricated;
  std::optional<Plateau>
      plateau;  ///< densities [kg/m^2] over which the dry share hardly changes, and that
};

/// First dose, of many, that wets each pixel of a surface.
struct WettingDoses {
  /// [kg/m^2], rising: round numbers at most 5 % apart from 0.001 g/m^2 to 10 g/m^2 or to what
  /// drowns the surface, and the densities of the settings; none for a surface without heights.
  std::vector<double> lubricant_densities;
  std::vector<std::uint16_t>
      first;  ///< per pixel, row by row: its place; their number where none is
};

/// True where the settings have oil that runs downhill, so that it fills depressions first and then
/// valleys, and only wets: it neither flows on nor carries load, and every film counts; and one
/// place of the tool.
bool has_density_curve(const CaseSettings& settings);

/// Finds the first doses that wet the pixels of `where`, in the shape of the surface or empty for
/// all; the others count as wet by none. They need no contact and hold for any. All doses are
/// reached in one pass of vanishing droplets (Model::limit), whatever model the settings ask for.
/// Throws as density_curves().
WettingDoses wetting_doses(const topography::Topography& surface, const FilmSettings& settings,
                           const Mask& where, const Observer& observer = {});

/// Finds those of all pixels in one run with the films of the settings, which are of droplets or of
/// their limit.
WettingDoses wetting_doses(const topography::Topography& surface, const FilmSettings& settings,
                           const std::function<void(FilmRecord&&)>& receive,
                           const Observer& observer = {});

/// Returns the share of a contact that each of the doses wets; 0 where nothing touches.
std::vector<double> lubricated_shares(const WettingDoses& doses, const Mask& contact);

/// Returns the friction of one contact whose wet share is known for rising densities [kg/m^2].
DensityCurve density_curve(const std::vector<double>& lubricant_densities,
                           const std::vector<double>& lubricated_shares,
                           const contact::Summary& contact, const CaseSettings& settings);

/// True where two densities differ by no more than the rounding of units.
bool are_same_density(double a, double b);

/// Largest relative difference of a dry share from that of the plateau at points on the plateau.
inline constexpr double kPlateauTolerance = 0.01;

/// Returns the densities over which the dry share of the contact hardly changes, and that share;
/// none where it changes throughout or all contact is under oil. A point of the curve is among them
/// exactly if its dry share is within kPlateauTolerance of that of the plateau.
std::optional<Plateau> plateau_of(const DensityCurve& curve);

/// Numbers and contact mask of a solved contact, in the shape of the surface.
struct Touching {
  contact::Summary summary;
  Mask mask;
  std::uint64_t surface = 0;  ///< digest of the pressed surface; 0 where it is not known
};
/// Takes from a contact what a curve needs.
Touching touching_of(const ContactRecord& contact);

/// Returns one curve for each contact with the surface. Empty for a surface without heights. Throws
/// InputError for invalid settings and contacts of another surface, Interrupted where the observer
/// asks to stop.
std::vector<DensityCurve> density_curves(const topography::Topography& surface,
                                         const std::vector<Touching>& contacts,
                                         const CaseSettings& settings,
                                         const Observer& observer = {});

}  // namespace tabor::cases
