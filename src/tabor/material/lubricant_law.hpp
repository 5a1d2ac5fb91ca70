#pragma once

#include <limits>
#include <span>

// Defines the value that a lubricant law returns, with its derivatives, and ranges of pressure.
namespace tabor::material {

/// Value of a law at one pressure, and its derivative by the pressure.
struct LawValue {
  double value = 0;
  double by_pressure = 0;  ///< [unit of value / Pa]
};

/// Value of a law at one pressure and temperature, and its derivatives.
struct ThermalLawValue {
  double value = 0;
  double by_pressure = 0;     ///< [unit of value / Pa]
  double by_temperature = 0;  ///< [unit of value / K]
};

/// Open range of pressures: the ends do not belong to it.
struct PressureRange {
  double lowest = -std::numeric_limits<double>::infinity();  ///< [Pa]
  double highest = std::numeric_limits<double>::infinity();  ///< [Pa]

  /// True where the pressure lies in the range; false for NaN.
  bool contains(double pressure) const { return lowest < pressure && pressure < highest; }
};

/// Temperatures enter laws in kelvin.
inline constexpr double kZeroCelsius = 273.15;  ///< [K]

namespace detail {

/// Sets value[i], by_pressure[i] = law at pressure[i]; the spans have the same length.
template <typename Law>
void evaluate_each(const Law& law, std::span<const double> pressure, std::span<double> value,
                   std::span<double> by_pressure) {
  for (std::size_t i = 0; i < pressure.size(); ++i) {
    const LawValue at = law.at(pressure[i]);
    value[i] = at.value;
    by_pressure[i] = at.by_pressure;
  }
}

}  // namespace detail
}  // namespace tabor::material
