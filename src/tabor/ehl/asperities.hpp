#pragma once

namespace tabor::ehl {

/// Solids that touch through a boundary film: where the gap would fall below it, they carry what
/// keeps it there.
struct Asperities {
  double boundary_film = 0;         ///< h_b [m]
  double friction_coefficient = 0;  ///< of what they carry
  double shear_strength = 0;        ///< [Pa] of what touches, besides

  /// Friction [N, or N/m] of so much load [N, N/m] on so much area [m^2, m].
  double friction(double carried, double area) const {
    return friction_coefficient * carried + shear_strength * area;
  }
};

/// Throws InputError for negative or non-finite values.
void check(const Asperities& asperities);

}  // namespace tabor::ehl
