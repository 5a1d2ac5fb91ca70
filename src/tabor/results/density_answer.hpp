#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tabor/cases/density_curve.hpp"
#include "tabor/cases/records.hpp"
#include "tabor/core/names.hpp"

// Interprets a curve of friction against the density of the lubricant: where its plateau ends, and
// on which side of it densities lie that were asked for.
namespace tabor::results {

/// Position of a density by its wet share: below the plateau of its curve, on it, or beyond it.
enum class Place { below, plateau, beyond };
inline constexpr auto kPlaces = names<Place>("below", "plateau", "beyond");

/// A density that was asked for and what was computed there, with the model that was asked for.
struct AskedDensity {
  double lubricant_density = 0;  ///< [kg/m^2]
  double lubricated_share = 0;
};

/// Returns the densities above zero of the records under this mean pressure [Pa], each once, in
/// their order.
std::vector<AskedDensity> asked_at(double mean_pressure,
                                   const std::vector<cases::FrictionRecord>& records);

/// Largest difference of a friction from that of vanishing droplets, and where it is.
struct LimitDifference {
  double friction = 0;           ///< its absolute value
  double mean_pressure = 0;      ///< [Pa]
  double lubricant_density = 0;  ///< [kg/m^2]
};

/// Returns how far the lubricated friction of the records, from films of any model, lies from the
/// curves, which are of vanishing droplets (Model::limit). nullopt where no record is on a curve.
std::optional<LimitDifference> difference_from_limit(
    const std::vector<cases::DensityCurve>& curves,
    const std::vector<cases::FrictionRecord>& records);

/// Returns the position of a wet share on the curve; nullopt for a curve without a plateau.
std::optional<Place> place_of(const cases::DensityCurve& curve, double lubricated_share);

/// A plateau whose wet share is below this counts as dry.
inline constexpr double kDryShare = 0.01;

/// Returns the position as one word: "dry" on a plateau that counts as dry, "no plateau" where
/// there is none.
std::string word_of_place(const cases::DensityCurve& curve, double lubricated_share);

/// Returns the wet share at a density [kg/m^2]. Between two points of the curve it lies on the
/// straight line over the logarithm of the density; before the first and after the last point it is
/// theirs.
double lubricated_share_at(const cases::DensityCurve& curve, double lubricant_density);

/// Points [kg/m^2] next to the plateau and outside it.
struct BesidePlateau {
  std::optional<double> below;   ///< the last before it
  std::optional<double> beyond;  ///< the first behind it
};

/// Returns the points next to the plateau, between which and its ends its edges lie. nullopt where
/// the curve ends on the plateau or has none.
BesidePlateau beside_plateau(const cases::DensityCurve& curve);

/// Returns the densities between which the oil level reaches the contacts, "1.15 to 1.2 g/m^2";
/// empty where it does not.
std::string text_of_upper_edge(const cases::DensityCurve& curve);

/// Returns one sentence: "the pockets under the contacts are full from 0.025 g/m^2 on (friction
/// 0.258); above 1.15 to 1.2 g/m^2 the oil level reaches the contacts; 0.9 g/m^2 (11.3 % wet) lies
/// ...".
std::string sentence_of(const cases::DensityCurve& curve, const std::vector<AskedDensity>& asked);

}  // namespace tabor::results
