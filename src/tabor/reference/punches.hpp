#pragma once

// Gives the closed forms of a flat punch and a cone on an elastic half-space.
namespace tabor::reference {

/// Rigid flat-ended cylinder pressed into an elastic half-space (Boussinesq 1885; Johnson 1985,
/// section 3.8).
struct FlatPunch {
  double radius = 0;             ///< a [m]
  double effective_modulus = 0;  ///< E* [Pa]

  double load(double indentation) const;                ///< F [N] = 2 a E* d
  double pressure(double indentation, double r) const;  ///< [Pa] E* d / (pi sqrt(a^2 - r^2))
};

/// Rigid cone whose flank makes the angle `slope_angle` with the undeformed surface (Love 1939,
/// doi:10.1093/qmath/os-10.1.161; Sneddon 1965, doi:10.1016/0020-7225(65)90019-4). The mean
/// pressure does not depend on the load.
struct Cone {
  double slope_angle = 0;        ///< b [rad], small
  double effective_modulus = 0;  ///< E* [Pa]

  double mean_pressure() const;                            ///< [Pa] E* tan(b) / 2
  double contact_radius(double load) const;                ///< a [m]
  double indentation(double contact_radius) const;         ///< d [m] = pi a tan(b) / 2
  double pressure(double contact_radius, double r) const;  ///< [Pa] p_mean acosh(a / r)
};

}  // namespace tabor::reference
