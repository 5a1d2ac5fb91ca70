#pragma once

// Gives closed forms of rigid lubricated bearings: cylinder, ellipsoid, slider, step and cavitated
// pocket.
namespace tabor::reference {

/// Films of a constant viscosity eta [Pa s] between rigid bodies, steady, long or on a line.
/// Entrainment speed u_m [m/s] is the mean of the two surface speeds.

/// Film of a cylinder over a flat, h = h0 + x^2/(2 R), flowing towards +x, inlet far away.
struct CylinderFilm {
  double radius = 0;             ///< R [m]
  double min_film = 0;           ///< h0 [m], << R
  double entrainment_speed = 0;  ///< u_m [m/s], > 0
  double viscosity = 0;          ///< eta [Pa s]

  double film(double x) const;  ///< h [m]

  /// Martin 1916 (Engineering 102, 119) and Guembel 1916, with the exit of Reynolds 1886
  /// (doi:10.1098/rstl.1886.0005): p = dp/dx = 0 where the film breaks. The mass-conserving
  /// condition gives the same.
  double martin_pressure(double x) const;  ///< [Pa]
  double martin_load() const;              ///< [N/m] 4.8950 eta u_m R / h0
  double martin_exit() const;              ///< [m] 0.47513 sqrt(2 R h0)

  /// Sommerfeld 1904: p = -4 eta u_m x / h^2, negative beyond the centre, carrying no load; cut
  /// there (half Sommerfeld) it carries 4 eta u_m R / h0.
  double sommerfeld_pressure(double x) const;  ///< [Pa]
  double half_sommerfeld_load() const;         ///< [N/m]
};

/// Returns the angle gamma of Reynolds' exit, tan(gamma) = x / sqrt(2 R h0): 0.44355.
double martin_exit_angle();

/// Film of an ellipsoid over a flat, h = h0 + x^2/(2 Rx) + y^2/(2 Ry), flowing towards +x: Kapitza
/// 1955 (Zhurnal Tekhnicheskoi Fiziki 25, 747), p = -12 eta u_m x / ((3 + 2 Rx/Ry) h^2), cut at x =
/// 0 for the load (half Sommerfeld).
struct KapitzaFilm {
  double radius_x = 0;           ///< Rx [m], in the direction of flow
  double radius_y = 0;           ///< Ry [m]
  double min_film = 0;           ///< h0 [m]
  double entrainment_speed = 0;  ///< u_m [m/s]
  double viscosity = 0;          ///< [Pa s]

  double film(double x, double y) const;      ///< [m]
  double pressure(double x, double y) const;  ///< [Pa], of either sign
  /// [N] 12 sqrt(2) pi eta u_m Rx sqrt(Ry/h0) / (3 + 2 Rx/Ry); a sphere: 10.6629 eta u_m R^1.5
  /// h0^-0.5.
  double load() const;
  /// [m] min_film at which the load is `load` [N].
  double film_at_load(double load) const;
};

/// Plane slider of length B whose film falls from h1 to h2; the other wall moves at U (Reynolds
/// 1886; Hamrock 1994). No pressure at both ends.
struct LinearSlider {
  double length = 0;         ///< B [m]
  double inlet_film = 0;     ///< h1 [m] > h2
  double outlet_film = 0;    ///< h2 [m] > 0
  double sliding_speed = 0;  ///< U [m/s] = 2 u_m
  double viscosity = 0;      ///< [Pa s]

  double pressure(double x) const;  ///< [Pa], x from the inlet
  /// [N/m] 6 eta U B^2 / (K^2 h2^2) [ln(1 + K) - 2 K / (2 + K)], K = h1/h2 - 1; largest, 0.16025
  /// eta U B^2 / h2^2, for K = 1.1889.
  double load() const;
};

/// Step bearing (Rayleigh 1918, Philosophical Magazine 35, 1): a film h1 along step_place, then h2.
/// The best of all shapes with given h2: h1/h2 = 1.8660, step at 0.7182 B, load 0.2063 eta U B^2 /
/// h2^2.
struct RayleighStep {
  double length = 0;         ///< B [m]
  double step_place = 0;     ///< [m] from the inlet, 0 < step_place < B
  double inlet_film = 0;     ///< h1 [m]
  double outlet_film = 0;    ///< h2 [m]
  double sliding_speed = 0;  ///< U [m/s]
  double viscosity = 0;      ///< [Pa s]

  double step_pressure() const;     ///< [Pa], the largest
  double pressure(double x) const;  ///< [Pa]
  double load() const;              ///< [N/m]
};

/// Parallel film h_l of length L with a deeper pocket [a, b], film h_p: the film ruptures at the
/// edge a and reforms inside the pocket, mass conserved (boundary conditions of Jakobsson, Floberg
/// and Olsson). Absolute pressures: p0 at both ends, p_c in the cavity. Codes that do not conserve
/// mass do not reproduce it. Precondition: pressure and speed such that the cavity lies in the
/// pocket, a < reformation() < b and 0 < fill() < 1.
struct CavitatedPocket {
  double length = 0;            ///< L [m]
  double begin = 0;             ///< a [m]
  double end = 0;               ///< b [m]
  double land_film = 0;         ///< h_l [m]
  double pocket_film = 0;       ///< h_p [m]
  double sliding_speed = 0;     ///< U [m/s] towards +x
  double viscosity = 0;         ///< [Pa s]
  double ambient_pressure = 0;  ///< p0 [Pa]
  double cavity_pressure = 0;   ///< p_c [Pa]

  double flow() const;              ///< q [m^2/s]
  double fill() const;              ///< theta [-] of the cavity = 2 q / (U h_p)
  double reformation() const;       ///< x_r [m]
  double end_pressure() const;      ///< p(b) [Pa], the largest
  double pressure(double x) const;  ///< [Pa]
  double load() const;              ///< [N/m], integral of the absolute pressure
};

/// Returns the pressure in a rigid film whose viscosity is eta0 exp(alpha p), from the pressure q
/// [Pa] that the constant viscosity eta0 gives: p = -ln(1 - alpha q) / alpha; infinite where alpha
/// q >= 1.
double barus_pressure(double constant_viscosity_pressure, double pressure_coefficient);

}  // namespace tabor::reference
