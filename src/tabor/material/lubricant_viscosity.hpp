#pragma once

#include <span>
#include <string_view>
#include <variant>

#include "tabor/core/names.hpp"
#include "tabor/material/lubricant_law.hpp"

// Computes the viscosity of lubricants under pressure and temperature (constant, Barus, Roelands).
namespace tabor::material {

/// Decrease of the ambient viscosity with temperature: -d ln(eta) / dT at ambient pressure and at
/// the reference temperature.
struct ThermalThinning {
  double coefficient = 0;            ///< beta [1/K], >= 0
  double reference_kelvin = 293.15;  ///< T0 [K]: where the ambient viscosity was measured
};

/// eta = eta0. Make it with constant_viscosity().
struct ConstantViscosity {
  double ambient = 0;  ///< eta0 [Pa s]

  /// Returns the viscosity at a pressure [Pa].
  LawValue at(double) const { return {ambient, 0}; }
  /// Returns the viscosity at a pressure [Pa] and a temperature [K].
  ThermalLawValue at(double, double) const { return {ambient, 0, 0}; }
};

/// eta = eta0 exp(alpha p - beta (T - T0)): Barus 1893, American Journal of Science 45, 87; in
/// temperature Reynolds 1886, doi:10.1098/rstl.1886.0005. Make it with barus_viscosity().
struct BarusViscosity {
  double ambient = 0;               ///< eta0 [Pa s]
  double pressure_coefficient = 0;  ///< alpha [1/Pa]
  ThermalThinning thermal;

  /// Returns the viscosity at a pressure [Pa].
  LawValue at(double pressure) const;
  /// Returns the viscosity at a pressure [Pa] and a temperature [K].
  ThermalLawValue at(double pressure, double kelvin) const;
};

/// eta = eta0 exp{ (ln eta0 + 9.67) [ ((T - 138) / (T0 - 138))^-S0 (1 + 5.1e-9 p)^z - 1 ] }, eta0
/// in Pa s, p in Pa, T in K: Roelands 1966 (thesis, Delft), in SI as Houpert 1985, Journal of
/// Tribology 107, 241. S0 = beta (T0 - 138) / (ln eta0 + 9.67). At p = -196 MPa every oil
/// has 6.31e-5 Pa s. Make it with roelands_viscosity() or roelands_viscosity_from_z().
struct RoelandsViscosity {
  double ambient = 0;    ///< eta0 [Pa s]
  double z = 0;          ///< [-]
  double log_ratio = 0;  ///< ln eta0 + 9.67 [-]
  ThermalThinning thermal;

  /// Returns the viscosity at a pressure [Pa].
  LawValue at(double pressure) const;
  /// Returns the viscosity at a pressure [Pa] and a temperature [K].
  ThermalLawValue at(double pressure, double kelvin) const;

  double pressure_coefficient() const;  ///< alpha [1/Pa] = d ln(eta) / dp at p = 0
  double temperature_slope() const;     ///< S0 [-]
};

/// One of the viscosity laws.
using Viscosity = std::variant<ConstantViscosity, BarusViscosity, RoelandsViscosity>;

/// Make a law. Throw InputError for ambient viscosities that are not positive, coefficients that
/// are negative, and, for Roelands, an ambient viscosity at or below exp(-9.67) Pa s = 6.31e-5 Pa
/// s.
ConstantViscosity constant_viscosity(double ambient);
BarusViscosity barus_viscosity(double ambient, double pressure_coefficient,
                               const ThermalThinning& thermal = {});
/// Makes Roelands' law with z = alpha / (5.1e-9 (ln eta0 + 9.67)), so that alpha is the slope of
/// ln(eta) at p = 0.
RoelandsViscosity roelands_viscosity(double ambient, double pressure_coefficient,
                                     const ThermalThinning& thermal = {});
RoelandsViscosity roelands_viscosity_from_z(double ambient, double z,
                                            const ThermalThinning& thermal = {});

/// The viscosity laws by name.
enum class ViscosityLaw { constant, barus, roelands };
inline constexpr auto kViscosityLaws = names<ViscosityLaw>("constant", "barus", "roelands");

/// Returns the law of a name: "constant", "barus", "roelands". Throws InputError with the nearest
/// name.
ViscosityLaw parse_viscosity_law(std::string_view name);
std::string_view name(ViscosityLaw law);
ViscosityLaw law_of(const Viscosity& viscosity);

/// Makes a law from the values of a case; `constant` ignores the coefficients.
Viscosity make_viscosity(ViscosityLaw law, double ambient, double pressure_coefficient,
                         const ThermalThinning& thermal = {});

double ambient_viscosity(const Viscosity& viscosity);     ///< eta0 [Pa s]
double pressure_coefficient(const Viscosity& viscosity);  ///< alpha [1/Pa] at p = 0

/// Return eta [Pa s] and its derivatives at one pressure [Pa] (and temperature [K]). Outside
/// computable_range() the value may be infinite or NaN.
LawValue viscosity_at(const Viscosity& viscosity, double pressure);
ThermalLawValue viscosity_at(const Viscosity& viscosity, double pressure, double kelvin);

/// Computes eta and its derivative for many pressures; the law is looked up once. All spans have
/// the same length.
void evaluate(const Viscosity& viscosity, std::span<const double> pressure, std::span<double> value,
              std::span<double> by_pressure);

/// Returns the pressures at which the law gives a positive finite viscosity with a margin for
/// computation: its exponent stays below 300.
PressureRange computable_range(const Viscosity& viscosity);

/// Returns the pressures at which the law is commonly trusted: up to 0.1 GPa for Barus, 1 GPa for
/// Roelands; rules of thumb, not limits of the formulas.
PressureRange trusted_range(const Viscosity& viscosity);

}  // namespace tabor::material
