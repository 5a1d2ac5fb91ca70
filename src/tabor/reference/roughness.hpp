#pragma once

// Gives theoretical contact areas of rough surfaces, and the friction that follows from them.
namespace tabor::reference {

/// Factor kappa of A / A0 = kappa P / (E* rms slope) at low load, with the areal rms slope <|grad
/// z|^2>^(1/2).

/// Asperity theory: Bush, Gibson & Thomas 1975, doi:10.1016/0043-1648(75)90145-3.
inline constexpr double kKappaBushGibsonThomas = 2.5066282746310002;  // sqrt(2 pi)

/// Factor kappa of Persson 2001, doi:10.1063/1.1388626.
inline constexpr double kKappaPersson = 1.5957691216057308;  // sqrt(8 / pi)

/// Returns Persson's area fraction at any load, from reduced pressure P / (E* rms slope):
/// erf(sqrt(2) P').
double persson_area_fraction(double reduced_pressure);

/// Returns the dry friction where every contact pixel carries the saturation pressure: tau / p_sat.
double saturated_friction(double shear_strength, double saturation_pressure);

/// Returns the dry friction of light elastic contact, independent of the load: kappa tau / (E* rms
/// slope).
double elastic_friction(double shear_strength, double effective_modulus, double rms_slope,
                        double kappa);

}  // namespace tabor::reference
