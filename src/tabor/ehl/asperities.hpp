#pragma once

#include <optional>

// Says how touching solids rub that a boundary film keeps apart.
namespace tabor::ehl {

/// Solids that touch through a boundary film: where the gap would fall below it, they carry what
/// keeps it there.
struct Asperities {
  double boundary_film = 0;                         ///< h_b [m]
  std::optional<double> friction_coefficient = {};  ///< of what they carry
  std::optional<double> shear_strength = {};        ///< [Pa] of what touches, besides

  /// True where their friction is known; a coefficient of 0 is known.
  bool has_friction() const { return friction_coefficient || shear_strength; }

  /// Friction [N, or N/m] of so much load [N, N/m] on so much area [m^2, m]; NaN where there is
  /// some and nothing is known about it.
  double friction(double carried, double area) const;
};

/// Throws InputError for negative or non-finite values.
void check(const Asperities& asperities);

}  // namespace tabor::ehl
