#pragma once

// Gives Hertz's closed form of a cylinder on a half-space, and the gap around a circular contact.
namespace tabor::reference {

/// Cylinder of radius R pressed along its side on an elastic half-space, per unit of length (Hertz
/// 1882; Johnson 1985, section 4.2c). Valid for b << R.
struct HertzLineContact {
  double radius = 0;             ///< R [m]
  double effective_modulus = 0;  ///< E* [Pa]
  double load = 0;               ///< F [N/m]
  double half_width = 0;         ///< b [m] = sqrt(4 F R / (pi E*))
  double max_pressure = 0;       ///< p0 [Pa] = 2 F / (pi b)

  double pressure(double x) const;  ///< [Pa] p0 sqrt(1 - x^2/b^2), 0 outside
  /// Returns the gap [m] outside: b^2/(2 R) (q sqrt(q^2 - 1) - acosh q), q = |x| / b; 0 inside.
  double gap(double x) const;
  /// Returns the displacement [m] into the half-space, zero at the distance `datum` [m] from a line
  /// force: the plane problem has no other reference.
  double displacement(double x, double datum) const;
};

/// Returns the contact at a load. Precondition: radius and modulus > 0, load >= 0.
HertzLineContact hertz_line_at_load(double radius, double effective_modulus, double load);

/// Returns the gap [m] outside the contact circle of a sphere (Johnson 1985, eq. 3.42a): a^2/(pi R)
/// [sqrt(q^2 - 1) + (q^2 - 2) acos(1/q)], q = |r| / a; 0 inside.
double hertz_gap(double sphere_radius, double contact_radius, double r);

}  // namespace tabor::reference
