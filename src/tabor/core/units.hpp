#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

// Reads values with units ("7 MPa") into SI and writes SI values with units.
namespace tabor {

/// Exponents of the SI base units of a quantity.
struct Dimension {
  int metre = 0;
  int kilogram = 0;
  int second = 0;
  int kelvin = 0;
  bool operator==(const Dimension&) const = default;
};

namespace dimension {
inline constexpr Dimension none{};
inline constexpr Dimension length{1, 0, 0, 0};
inline constexpr Dimension wavevector{-1, 0, 0, 0};
inline constexpr Dimension pressure{-1, 1, -2, 0};
inline constexpr Dimension areal_density{-2, 1, 0, 0};
inline constexpr Dimension density{-3, 1, 0, 0};
inline constexpr Dimension speed{1, 0, -1, 0};
inline constexpr Dimension viscosity{-1, 1, -1, 0};
inline constexpr Dimension per_pressure{1, -1, 2, 0};
inline constexpr Dimension pressure_gradient{-2, 1, -2, 0};
inline constexpr Dimension force{1, 1, -2, 0};
inline constexpr Dimension force_per_length{0, 1, -2, 0};
inline constexpr Dimension mass{0, 1, 0, 0};
inline constexpr Dimension mass_per_length{-1, 1, 0, 0};
inline constexpr Dimension time{0, 0, 1, 0};
inline constexpr Dimension temperature{0, 0, 0, 1};
}  // namespace dimension

/// A value with its dimension.
struct Quantity {
  double value = 0;  ///< SI
  Dimension dimension;
};

/// Parses "0.45 g/m^2", "7MPa", "1.5e-8 1/Pa", "0.1 Pa s", "5 mm/s", "0.33" to an SI value and its
/// dimension. Throws InputError naming the part that was not understood.
Quantity parse_quantity(std::string_view text);

/// Returns the SI value of `text`, which must have the expected dimension. `name` is the option or
/// key the text came from, e.g. "--pressure"; the message shows the corrected form ("--pressure
/// 7MPa"), see likely_unit.hpp.
double parse_si(std::string_view text, Dimension expected, std::string_view name);

/// Parses comma-separated values, each with its own unit ("2MPa,7MPa"); throws on an empty list.
std::vector<double> parse_si_list(std::string_view text, Dimension expected, std::string_view name);

/// Returns the factor that converts a number in `unit` ("um", "µm", "nm", "Å", "mm", "m", ...) into
/// SI, if `unit` is known and has that dimension. For readers of instrument files.
std::optional<double> unit_factor(std::string_view unit, Dimension expected);

/// Returns the engineering form: format_si(6.7e-7, "m") = "670 nm", format_si(7e6, "Pa") = "7 MPa".
std::string format_si(double value, std::string_view si_unit, int significant_digits = 4);

/// Format numbers that may be unknown: NaN -> "-".
std::string si(double value, const std::string& unit);  ///< 7e6, "Pa" -> "7 MPa"
std::string plain(double value, int digits = 4);        ///< without a unit, 0.29168 -> "0.2917"
std::string percent(double fraction, int digits = 3);   ///< 0.02134 -> "2.13 %"

/// Converts an areal density [kg/m^2] to g/m^2 without rounding error of the factor 1000: 0.45e-3
/// gives 0.45.
double in_g_per_m2(double lubricant_density);

}  // namespace tabor
