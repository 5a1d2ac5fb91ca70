#pragma once

#include <array>

// Gives the contact of a rigid flat with wavy surfaces: Westergaard's closed form, and tabulated
// numerical values.
namespace tabor::reference {

/// Returns the pressure amplitude [Pa] that flattens one cosine mode of the height: E* |q| A / 2
/// (Johnson 1985, eq. 13.7). A sum of modes is in full contact once P is at least minus the minimum
/// of the sum of their pressures.
double flattening_pressure(double effective_modulus, double wavevector, double amplitude);

/// Contact of a rigid flat on z = D cos(2 pi x / L), plane strain (Westergaard 1939; Johnson 1985,
/// section 13.2).
struct WestergaardWave {
  double amplitude = 0;          ///< D [m]
  double wavelength = 0;         ///< L [m]
  double effective_modulus = 0;  ///< E* [Pa]

  /// Returns p* [Pa] = pi E* D / L, the pressure from which on the contact is full.
  double full_contact_pressure() const;

  /// Returns a [m] from P = p* sin^2(pi a / L); L/2 at full contact.
  double half_width(double mean_pressure) const;
  double area_fraction(double mean_pressure) const;  ///< 2 a / L

  /// Returns the height of the flat [m] over the mean plane of the surface, which is also the mean
  /// gap: D (1 - r + r ln r), r = P / p*. It follows from p* and a: a further load dP meets a row
  /// of flat punches of half-width a, whose compliance is 2 L / (pi E*) ln(1 / sin(pi a / L)).
  double separation(double mean_pressure) const;

  /// Returns p(x) [Pa], x measured from a crest; P + p* cos(2 pi x / L) at full contact.
  double pressure(double mean_pressure, double x) const;
};

/// Returns p* [Pa] of a rigid flat on z = D cos(2 pi x / L) cos(2 pi y / L) (Johnson, Greenwood &
/// Higginson 1985, doi:10.1016/0020-7403(85)90029-3). No closed form between the limits: kJghTable
/// holds values of numerical solutions. Loads are ratios P / p*.
double jgh_full_contact_pressure(double effective_modulus, double amplitude, double wavelength);

/// Returns the area fraction of separate Hertz contacts, for P << p*: pi (3 P / (8 pi p*))^(2/3).
double jgh_area_at_low_load(double load_ratio);

/// Returns the area fraction near full contact, P -> p*: 1 - 3 / (2 pi) (1 - P / p*).
double jgh_area_at_high_load(double load_ratio);

/// Entry of kJghTable.
struct JghPoint {
  double load_ratio;     ///< P / p*
  double area_fraction;  ///< A / A0, within 3e-3
};
inline constexpr std::array<JghPoint, 7> kJghTable{
    {{.005, .0227}, {.02, .0587}, {.1, .1905}, {.3, .514}, {.5, .704}, {.7, .840}, {.9, .9506}}};

}  // namespace tabor::reference
