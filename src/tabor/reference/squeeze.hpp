#pragma once

// Gives closed forms of rigid bodies that squeeze out a liquid of constant viscosity.
namespace tabor::reference {

/// Rigid bodies approach each other through a liquid of constant viscosity, at speed v [m/s] > 0
/// when the gap closes. Pressure 0 outside.

/// Sphere (paraboloid, h = h0 + r^2/(2 R)) against a flat. The liquid reaches up to the gap
/// `wetted_gap`, infinity if it is unbounded (then Taylor's formula, 6 pi eta R^2 v / h0).
struct SphereSqueeze {
  double radius = 0;      ///< R [m]
  double viscosity = 0;   ///< eta [Pa s]
  double wetted_gap = 0;  ///< h00 [m] > h0

  double pressure(double h, double speed) const;  ///< [Pa] 3 eta R v (1/h^2 - 1/h00^2), at gap h
  /// [N] (6 pi eta R^2 v / h0) ((h00 - h0) / h00)^2.
  double force(double min_film, double speed) const;
};

/// Cylinder of radius R against a flat, unbounded: p = 6 eta R v / h^2, force per length 3 sqrt(2)
/// pi eta v (R/h0)^(3/2).
struct CylinderSqueeze {
  double radius = 0;     ///< R [m]
  double viscosity = 0;  ///< [Pa s]

  double pressure(double h, double speed) const;      ///< [Pa], at gap h
  double force(double min_film, double speed) const;  ///< [N/m]
};

/// Parallel discs of radius R (Stefan 1874): F = 3 pi eta R^4 v / (2 h^3).
struct DiscSqueeze {
  double radius = 0;     ///< R [m]
  double viscosity = 0;  ///< [Pa s]

  double pressure(double r, double film, double speed) const;  ///< [Pa] 3 eta v (R^2 - r^2) / h^3
  double force(double film, double speed) const;               ///< [N]
  /// [s] that a constant force [N] takes to close the film from `from` to `to` [m].
  double closing_time(double force, double from, double to) const;
};

/// Rigid ball of mass m that its own inertia carries towards a flat, without gravity: m dv/dh = 6
/// pi eta R^2 / h. It stops, at any speed, at the gap h exp(-Stokes number): without elasticity
/// there is no rebound (Davis, Serayssol & Hinch 1986, doi:10.1017/S0022112086002392).
struct BallApproach {
  double radius = 0;     ///< R [m]
  double mass = 0;       ///< m [kg]
  double viscosity = 0;  ///< [Pa s]

  double stokes_number(double speed) const;                      ///< m v / (6 pi eta R^2)
  double speed_at(double gap, double from, double speed) const;  ///< [m/s], 0 once it stopped
  double stopping_gap(double from, double speed) const;          ///< [m]
};

}  // namespace tabor::reference
