#include "tabor/core/likely_unit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "tabor/core/text.hpp"

namespace tabor {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// What values of a quantity look like.
struct Ordinary {
  std::string_view words;  ///< its name ends with them; "" for all others of the dimension
  Dimension dimension;
  double least, most;  ///< [SI]
  std::string_view number;
  std::array<std::string_view, 4> units;  ///< the likeliest first, the example's
};

// The longer of names that end alike stands first, and what a dimension has in common last.
constexpr std::array kOrdinary{
    Ordinary{"youngs modulus", dimension::pressure, 1e5, 1.3e12, "70", {"GPa", "Pa", "MPa"}},
    Ordinary{"bulk modulus", dimension::pressure, 1e5, 1.3e12, "1.5", {"GPa", "Pa", "MPa"}},
    Ordinary{"e prime", dimension::pressure, 1e5, 2e12, "230", {"GPa", "Pa", "MPa"}},
    Ordinary{"plastic pressure", dimension::pressure, 1e7, 1e11, "4", {"GPa", "MPa", "Pa"}},
    Ordinary{"saturation pressure", dimension::pressure, 1e5, 1e11, "240", {"MPa", "GPa", "Pa"}},
    Ordinary{"shear strength", dimension::pressure, 1e3, 1e10, "70", {"MPa", "GPa", "Pa"}},
    Ordinary{"eyring stress", dimension::pressure, 1e4, 1e9, "5", {"MPa", "Pa"}},
    Ordinary{"limiting stress", dimension::pressure, 1e4, 1e10, "50", {"MPa", "GPa", "Pa"}},
    Ordinary{"roller spring", dimension::pressure, 1e6, 1e13, "2.2e10", {"N/m^2", "GPa"}},
    Ordinary{"", dimension::pressure, 1, 1e10, "7", {"MPa", "Pa", "GPa"}},

    Ordinary{"ball radius x", dimension::length, 1e-5, 1, "10", {"mm", "m", "um"}},
    Ordinary{"ball radius y", dimension::length, 1e-5, 1, "10", {"mm", "m", "um"}},
    Ordinary{"ball radius", dimension::length, 1e-5, 1, "10", {"mm", "m", "um"}},
    Ordinary{"cylinder radius", dimension::length, 1e-5, 10, "10", {"mm", "m", "um"}},
    Ordinary{"effective radius", dimension::length, 1e-5, 10, "9.2", {"mm", "m", "um"}},
    Ordinary{"tip radius", dimension::length, 1e-9, 1e-4, "2", {"um", "nm"}},
    Ordinary{"z scale", dimension::length, 1e-13, 1e-5, "1", {"nm", "um"}},
    Ordinary{"profile cutoff", dimension::length, 1e-5, 0.025, "0.8", {"mm", "um"}},
    Ordinary{"track length", dimension::length, 1e-5, 1e3, "10", {"mm", "m", "um"}},
    Ordinary{"stroke", dimension::length, 1e-6, 1, "1", {"mm", "um", "m"}},
    Ordinary{"wear width", dimension::length, 1e-5, 10, "10", {"mm", "um", "m"}},
    Ordinary{"dry below", dimension::length, 1e-10, 1e-6, "2", {"nm", "um"}},
    Ordinary{"boundary film", dimension::length, 1e-10, 1e-6, "5", {"nm", "um"}},
    Ordinary{"", dimension::length, 0, 0.1, "1", {"um", "nm"}},

    Ordinary{"oil density", dimension::density, 500, 3000, "900", {"kg/m^3", "g/cm^3"}},
    Ordinary{"", dimension::density, 500, 25000, "7800", {"kg/m^3", "g/cm^3"}},
    Ordinary{"", dimension::areal_density, 0, 0.1, "0.45", {"g/m^2", "mg/m^2"}},

    Ordinary{"ball speed", dimension::speed, 1e-4, 50, "0.2", {"m/s", "mm/s"}},
    Ordinary{"roller speed", dimension::speed, 1e-4, 50, "0.25", {"m/s", "mm/s"}},
    Ordinary{"", dimension::speed, 0, 100, "5", {"mm/s", "m/s"}},

    Ordinary{"damping", dimension::viscosity, 0, kInfinity, "1e5", {"N*s/m^2"}},
    Ordinary{"", dimension::viscosity, 1e-5, 20, "0.1", {"Pa*s", "mPa*s"}},
    Ordinary{"hardening", dimension::pressure_gradient, 1e9, 1e16, "100", {"MPa/um", "Pa/m"}},
    Ordinary{"wear coefficient", dimension::per_pressure, 0, 1e-8, "1e-15", {"m^2/N"}},
    Ordinary{"", dimension::per_pressure, 1e-10, 1e-6, "2e-8", {"1/Pa", "1/GPa"}},

    Ordinary{"", dimension::wavevector, 1, 1e11, "0.1", {"1/um", "1/mm", "1/m"}},
    Ordinary{"", dimension::force_per_length, 1e-2, 1e9, "5000", {"N/m", "N/mm"}},
    Ordinary{"", dimension::mass_per_length, 1e-6, 1e5, "30", {"kg/m"}},
    Ordinary{"", dimension::force, 1e-6, 1e6, "20", {"N", "mN"}},
    Ordinary{"", dimension::mass, 1e-9, 1e3, "32.5", {"g", "kg"}},
    Ordinary{"impact profiles", dimension::time, 0, 1, "100", {"us", "ms", "s"}},
    Ordinary{"time step", dimension::time, 0, 1e-2, "1", {"us", "ns", "ms"}},
    Ordinary{"", dimension::time, 1e-6, 1e4, "1", {"ms", "s"}},
    Ordinary{"", dimension::temperature, 200, 700, "313", {"K"}},
};

/// "case.toml:3: ball.youngs_modulus" -> "case toml:3: ball youngs modulus"
std::string words_of(std::string_view name) {
  std::string words(name);
  std::replace_if(
      words.begin(), words.end(), [](char c) { return c == '-' || c == '_' || c == '.'; }, ' ');
  return words;
}

const Ordinary* find(std::string_view name, Dimension dimension) {
  const std::string words = words_of(name);
  const auto found =
      std::find_if(kOrdinary.begin(), kOrdinary.end(), [&](const Ordinary& ordinary) {
        return ordinary.dimension == dimension && std::string_view(words).ends_with(ordinary.words);
      });
  return found == kOrdinary.end() ? nullptr : &*found;
}

bool is_ordinary(double value, std::string_view unit, const Ordinary& ordinary) {
  const auto factor = unit_factor(unit, ordinary.dimension);
  const double size = std::abs(value * factor.value_or(std::nan("")));
  // A little slack, since 5 times 0.1 may be above 0.5.
  return size >= ordinary.least * (1 - 1e-9) && size <= ordinary.most * (1 + 1e-9);
}

}  // namespace

std::string WrittenValue::as_word() const {
  return number + (unit.starts_with("1/") ? unit.substr(1) : unit);
}

std::string WrittenValue::as_text() const { return unit.empty() ? number : number + " " + unit; }

WrittenValue example_value(std::string_view name, Dimension dimension) {
  const Ordinary* ordinary = find(name, dimension);
  if (ordinary == nullptr) return {"1", ""};
  return {std::string(ordinary->number), std::string(ordinary->units.front())};
}

WrittenValue with_likely_unit(std::string_view number, std::string_view name, Dimension dimension) {
  const Ordinary* ordinary = find(name, dimension);
  const auto value = parse_number(number);
  if (ordinary == nullptr || !value) return example_value(name, dimension);
  if (*value == 0) return {std::string(number), std::string(ordinary->units.front())};
  for (const std::string_view unit : ordinary->units) {
    if (!unit.empty() && is_ordinary(*value, unit, *ordinary)) {
      return {std::string(number), std::string(unit)};
    }
  }
  return example_value(name, dimension);
}

}  // namespace tabor
