#pragma once

// Computes the viscosity of glycerol-water mixtures.
namespace tabor::material {

/// Coefficient c of the mixing exponent a = 0.705 - c T.
enum class GlycerolWaterFit {
  cheng,   ///< c = 0.0017, as published
  thesis,  ///< c = 0.0012, as printed in Akchurin's thesis; 2.6 % less at 95 % and 24 degrees
           ///< Celsius
};

/// Returns the viscosity [Pa s] of a glycerol-water mixture: Cheng 2008, doi:10.1021/ie071349z.
/// Mass fraction of glycerol 0 .. 1, 273.15 .. 373.15 K, at ambient pressure; outside, InputError.
double glycerol_water_viscosity(double glycerol_mass_fraction, double kelvin,
                                GlycerolWaterFit fit = GlycerolWaterFit::cheng);

}  // namespace tabor::material
