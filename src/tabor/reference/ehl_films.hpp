#pragma once

// Gives published formulas for the film thickness of elastohydrodynamic line and point contacts.
namespace tabor::reference {

/// Film thickness of smooth, fully flooded, isothermal, Newtonian elastohydrodynamic contacts. The
/// formulas' E' is 2 E*.

/// Film of a cylinder on a flat, per unit of length.
struct LineContactFilm {
  double radius = 0;                ///< R [m]
  double effective_modulus = 0;     ///< E* [Pa]
  double load = 0;                  ///< F [N/m]
  double entrainment_speed = 0;     ///< u_m [m/s]
  double viscosity = 0;             ///< eta0 [Pa s]
  double pressure_coefficient = 0;  ///< alpha [1/Pa]

  double speed_group() const;     ///< U = eta0 u_m / (E' R)
  double load_group() const;      ///< W = F / (E' R)
  double material_group() const;  ///< G = alpha E'
  double moes_load() const;       ///< M = W (2 U)^(-1/2)
  double moes_viscosity() const;  ///< L = G (2 U)^(1/4)

  /// Minimum film [m] in the four limits of Moes' chart, h / (R sqrt(2 U)) = 2.45 / M, 2.05 M^-0.2,
  /// 1.05 L^(2/3), 0.99 M^(-1/8) L^(3/4) (Moes 1992, Wear 159, 57).
  double rigid_isoviscous() const;
  double elastic_isoviscous() const;
  double rigid_piezoviscous() const;
  double elastic_piezoviscous() const;
  /// Minimum film [m] anywhere in the chart: Moes' interpolation between those limits,
  ///   { [ (0.99 M^(-1/8) L^(3/4) t)^r + (2.05 M^-0.2)^r ]^(s/r) + (2.45 / M)^s }^(1/s),
  ///   r = exp(1 - 3/(L + 4)), s = 3 - exp(-1/(2 M)), t = 1 - exp(-3.5 M^(1/8) L^(-1/4)).
  double moes_min_film() const;

  /// [m] 2.65 U^0.7 G^0.54 W^-0.13 R (Dowson & Higginson, Elasto-hydrodynamic Lubrication, 1966).
  /// Steel and mineral oil: elastic and piezoviscous, G of some thousands; far off elsewhere.
  double dowson_higginson_min_film() const;

  /// [m] (2.3664 eta0 u_m alpha sqrt(R) (pi E* / F)^(1/8))^(8/11): Ertel and Grubin 1949, the inlet
  /// before a Hertz contact that the film does not change. The film of the parallel part, for high
  /// loads and alpha.
  double grubin_film() const;
};

/// Returns the gap [-] before a Hertz line contact, in units of F / (pi E*), x <= -1 or >= 1 in
/// half widths.
double grubin_gap(double x);

/// Returns the integral of d / (H + d)^3 over the inlet, d = grubin_gap, H > 0 the film in the same
/// units: the reduced pressure at the contact's edge. Grubin fits it by 0.0986 H^(-11/8), good near
/// H = 0.1 to 0.2 only.
double grubin_inlet_integral(double film);

/// Film of an ellipsoid on a flat, entrainment along x.
struct PointContactFilm {
  double radius_x = 0;              ///< Rx [m], along the entrainment
  double radius_y = 0;              ///< Ry [m], >= Rx
  double effective_modulus = 0;     ///< E* [Pa]
  double load = 0;                  ///< F [N]
  double entrainment_speed = 0;     ///< u_m [m/s]
  double viscosity = 0;             ///< eta0 [Pa s]
  double pressure_coefficient = 0;  ///< alpha [1/Pa]

  double speed_group() const;     ///< U = eta0 u_m / (E' Rx)
  double load_group() const;      ///< W = F / (E' Rx^2)
  double material_group() const;  ///< G = alpha E'
  double moes_load() const;       ///< M = W (2 U)^(-3/4)
  double moes_viscosity() const;  ///< L = G (2 U)^(1/4)

  /// [m] nijenbanning_central_film() of these groups.
  double nijenbanning_central() const;

  /// [m] 2.69 U^0.67 G^0.53 W^-0.067 (1 - 0.61 e^(-0.73 k)) Rx and 3.63 U^0.68 G^0.49 W^-0.073
  /// (1 - e^(-0.68 k)) Rx: Hamrock & Dowson 1977, doi:10.1115/1.3453074; k = (Ry/Rx)^(2/pi), 1 for
  /// a sphere (Hamrock & Brewe 1983). Fitted for k of 1 to 8, bronze, steel and silicon nitride in
  /// mineral oils.
  double hamrock_dowson_central() const;
  double hamrock_dowson_min() const;
};

/// Returns the central film h / (Rx sqrt(2 U)) of an incompressible liquid from Moes' M and L and
/// the ratio Rx / Ry, 0 < ratio <= 1: Nijenbanning, Venner & Moes 1994,
/// doi:10.1016/0043-1648(94)90150-3. For a compressible one divide by the relative density at the
/// Hertz pressure. In its rigid isoviscous limit it lies 23 % above the exact film of long
/// ellipses.
double nijenbanning_central_film(double moes_load, double moes_viscosity, double radius_ratio);

}  // namespace tabor::reference
