#pragma once

#include <span>
#include <string_view>

#include "tabor/core/names.hpp"
#include "tabor/material/lubricant_law.hpp"

// Computes the density of lubricants under pressure.
namespace tabor::material {

/// Density over ambient density: rho / rho0 = (c + k p) / (c + p). It starts at 1 and tends to k.
/// One shape holds every law here, so that nothing is looked up per node. Make it with the
/// functions below.
struct RelativeDensity {
  double pressure_scale = 1e100;  ///< c [Pa]; no pressure comes near the default
  double limit = 1;               ///< k [-]; 1 is incompressible

  /// Returns the relative density at a pressure [Pa].
  LawValue at(double pressure) const {
    const double sum = pressure_scale + pressure;
    return {(pressure_scale + limit * pressure) / sum, (limit - 1) * pressure_scale / (sum * sum)};
  }
};

/// The density laws by name.
enum class DensityLaw { constant, dowson_higginson, rounded_dowson_higginson };
inline constexpr auto kDensityLaws =
    names<DensityLaw>("constant", "dowson-higginson", "rounded-dowson-higginson");

/// Returns the law of a name: "constant", "dowson-higginson", "rounded-dowson-higginson". Throws
/// InputError with the nearest name.
DensityLaw parse_density_law(std::string_view name);
std::string_view name(DensityLaw law);

/// constant: rho = rho0.
/// dowson_higginson: rho / rho0 = 1 + 0.6e-9 p / (1 + 1.7e-9 p), p in Pa, for mineral oils (Dowson
/// & Higginson, Elasto-hydrodynamic Lubrication, Pergamon 1966); that is c = 588 MPa, k = 1.353.
/// rounded_dowson_higginson: (5.9e8 + 1.34 p) / (5.9e8 + p), the same with rounded constants, as in
/// the line contact of Akchurin's thesis.
RelativeDensity relative_density(DensityLaw law);

/// Computes rho / rho0 and its derivative at many pressures [Pa]. All spans have the same length.
void evaluate(const RelativeDensity& density, std::span<const double> pressure,
              std::span<double> value, std::span<double> by_pressure);

/// Returns the pressures at which the law gives a positive density: above -c / k.
PressureRange computable_range(const RelativeDensity& density);

/// Returns the pressures at which the law is commonly trusted: up to 0.4 GPa, a rule of thumb.
PressureRange trusted_range(const RelativeDensity& density);

}  // namespace tabor::material
