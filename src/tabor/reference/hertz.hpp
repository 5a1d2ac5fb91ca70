#pragma once

// Gives Hertz's closed form of a sphere on an elastic half-space.
namespace tabor::reference {

/// Sphere (paraboloid of radius R) pressed on an elastic half-space. Hertz 1882; Johnson 1985,
/// section 4.2. Valid for a << R.
struct HertzContact {
  double sphere_radius = 0;      ///< R [m]
  double effective_modulus = 0;  ///< E* [Pa]
  double load = 0;               ///< F [N]
  double radius = 0;             ///< a [m], of the contact circle
  double approach = 0;           ///< delta [m], of distant points
  double max_pressure = 0;       ///< p0 [Pa], at the centre
};

/// Return the contact at a load or an approach. Precondition: radius and modulus > 0, load or
/// approach >= 0.
HertzContact hertz_at_load(double sphere_radius, double effective_modulus, double load);
HertzContact hertz_at_approach(double sphere_radius, double effective_modulus, double approach);

/// Returns p(r) [Pa] = p0 sqrt(1 - r^2/a^2), 0 outside.
double hertz_pressure(const HertzContact& contact, double r);

/// Returns the surface displacement [m] into the half-space, measured from infinity (Johnson 1985,
/// eqs. 3.41a and 3.42a).
double hertz_displacement(const HertzContact& contact, double r);

}  // namespace tabor::reference
