#pragma once

#include <limits>
#include <span>

namespace tabor::material {

/// What a law says at one pressure: a value and its derivative by the pressure.
struct LawValue {
  double value = 0;
  double by_pressure = 0;  ///< [unit of value / Pa]
};

/// The same at one pressure and temperature.
struct ThermalLawValue {
  double value = 0;
  double by_pressure = 0;     ///< [unit of value / Pa]
  double by_temperature = 0;  ///< [unit of value / K]
};

/// Pressures between two ends, which do not belong to it.
struct PressureRange {
  double lowest = -std::numeric_limits<double>::infinity();  ///< [Pa]
  double highest = std::numeric_limits<double>::infinity();  ///< [Pa]

  /// False for NaN.
  bool contains(double pressure) const { return lowest < pressure && pressure < highest; }
};

/// Temperatures enter laws in kelvin.
inline constexpr double kZeroCelsius = 273.15;  ///< [K]

namespace detail {

/// value[i], by_pressure[i] = law at pressure[i]; the spans have the same length.
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
