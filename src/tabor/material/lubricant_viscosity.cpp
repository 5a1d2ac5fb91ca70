#include "tabor/material/lubricant_viscosity.hpp"

#include <fmt/core.h>

#include <cassert>
#include <cmath>

#include "tabor/core/error.hpp"

namespace tabor::material {
namespace {

constexpr double kPole = 9.67;             // -ln of the viscosity where all isotherms meet [Pa s]
constexpr double kPressureScale = 5.1e-9;  // [1/Pa], that is 1 / 196 MPa
constexpr double kColdest = 138;           // [K], where the isobars meet
constexpr double kMaxExponent = 300;       // exp of twice this is still finite in double precision
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Comparisons are written so that NaN fails them.
void check_ambient(double ambient) {
  if (!(ambient > 0 && std::isfinite(ambient))) {
    throw InputError("viscosity", fmt::format("{} Pa s", ambient), "a positive number",
                     "give for example 0.1 Pa s");
  }
}

void check_not_negative(const char* what, double value, const char* unit, const char* remedy) {
  if (!(value >= 0 && std::isfinite(value))) {
    throw InputError(what, fmt::format("{}{}", value, unit), "zero or a positive number", remedy);
  }
}

void check_thermal(const ThermalThinning& thermal, double coldest) {
  check_not_negative("temperature coefficient of the viscosity", thermal.coefficient, " 1/K",
                     "give for example 0.04 1/K");
  if (!(thermal.reference_kelvin > coldest && std::isfinite(thermal.reference_kelvin))) {
    throw InputError("reference temperature", fmt::format("{} K", thermal.reference_kelvin),
                     fmt::format("more than {} K", coldest), "");
  }
}

void check_pressure_coefficient(double value) {
  check_not_negative("pressure-viscosity coefficient", value, " 1/Pa",
                     "give for example 2e-8 1/Pa");
}

double log_ratio_of(double ambient) {
  check_ambient(ambient);
  const double log_ratio = std::log(ambient) + kPole;
  if (!(log_ratio > 0)) {
    throw InputError("viscosity", fmt::format("{} Pa s", ambient),
                     fmt::format("more than {:.3g} Pa s for the law of Roelands", std::exp(-kPole)),
                     "use the law of Barus");
  }
  return log_ratio;
}

}  // namespace

LawValue BarusViscosity::at(double pressure) const {
  const double value = ambient * std::exp(pressure_coefficient * pressure);
  return {value, pressure_coefficient * value};
}

ThermalLawValue BarusViscosity::at(double pressure, double kelvin) const {
  const double heating = thermal.coefficient * (kelvin - thermal.reference_kelvin);
  const double value = ambient * std::exp(pressure_coefficient * pressure - heating);
  return {value, pressure_coefficient * value, -thermal.coefficient * value};
}

LawValue RoelandsViscosity::at(double pressure) const {
  const double base = 1 + kPressureScale * pressure;
  const double power = std::pow(base, z);
  const double value = ambient * std::exp(log_ratio * (power - 1));
  return {value, value * log_ratio * z * kPressureScale * power / base};
}

ThermalLawValue RoelandsViscosity::at(double pressure, double kelvin) const {
  const double base = 1 + kPressureScale * pressure;
  const double above = kelvin - kColdest;
  const double slope = temperature_slope();
  const double power =
      std::pow(base, z) * std::pow(above / (thermal.reference_kelvin - kColdest), -slope);
  const double value = ambient * std::exp(log_ratio * (power - 1));
  return {value, value * log_ratio * z * kPressureScale * power / base,
          -value * log_ratio * slope * power / above};
}

double RoelandsViscosity::pressure_coefficient() const { return log_ratio * z * kPressureScale; }

double RoelandsViscosity::temperature_slope() const {
  return thermal.coefficient * (thermal.reference_kelvin - kColdest) / log_ratio;
}

ConstantViscosity constant_viscosity(double ambient) {
  check_ambient(ambient);
  return {ambient};
}

BarusViscosity barus_viscosity(double ambient, double pressure_coefficient,
                               const ThermalThinning& thermal) {
  check_ambient(ambient);
  check_pressure_coefficient(pressure_coefficient);
  check_thermal(thermal, 0);
  return {ambient, pressure_coefficient, thermal};
}

RoelandsViscosity roelands_viscosity(double ambient, double pressure_coefficient,
                                     const ThermalThinning& thermal) {
  check_pressure_coefficient(pressure_coefficient);
  const double z = pressure_coefficient / (kPressureScale * log_ratio_of(ambient));
  return roelands_viscosity_from_z(ambient, z, thermal);
}

RoelandsViscosity roelands_viscosity_from_z(double ambient, double z,
                                            const ThermalThinning& thermal) {
  const double log_ratio = log_ratio_of(ambient);
  check_not_negative("Roelands' z", z, "", "give for example 0.6");
  check_thermal(thermal, kColdest);
  return {ambient, z, log_ratio, thermal};
}

ViscosityLaw parse_viscosity_law(std::string_view text) {
  return kViscosityLaws.parse(text, "viscosity law");
}
std::string_view name(ViscosityLaw law) { return kViscosityLaws.of(law); }

ViscosityLaw law_of(const Viscosity& viscosity) {
  return static_cast<ViscosityLaw>(viscosity.index());  // same order
}

Viscosity make_viscosity(ViscosityLaw law, double ambient, double pressure_coefficient,
                         const ThermalThinning& thermal) {
  switch (law) {
    case ViscosityLaw::constant:
      return constant_viscosity(ambient);
    case ViscosityLaw::barus:
      return barus_viscosity(ambient, pressure_coefficient, thermal);
    case ViscosityLaw::roelands:
      return roelands_viscosity(ambient, pressure_coefficient, thermal);
  }
  return constant_viscosity(ambient);
}

double ambient_viscosity(const Viscosity& viscosity) {
  return std::visit([](const auto& law) { return law.ambient; }, viscosity);
}

double pressure_coefficient(const Viscosity& viscosity) {
  const LawValue ambient = viscosity_at(viscosity, 0);
  return ambient.by_pressure / ambient.value;
}

LawValue viscosity_at(const Viscosity& viscosity, double pressure) {
  return std::visit([&](const auto& law) { return law.at(pressure); }, viscosity);
}

ThermalLawValue viscosity_at(const Viscosity& viscosity, double pressure, double kelvin) {
  return std::visit([&](const auto& law) { return law.at(pressure, kelvin); }, viscosity);
}

void evaluate(const Viscosity& viscosity, std::span<const double> pressure, std::span<double> value,
              std::span<double> by_pressure) {
  assert(value.size() == pressure.size() && by_pressure.size() == pressure.size());
  std::visit([&](const auto& law) { detail::evaluate_each(law, pressure, value, by_pressure); },
             viscosity);
}

PressureRange computable_range(const Viscosity& viscosity) {
  if (const auto* barus = std::get_if<BarusViscosity>(&viscosity)) {
    const double bound =
        barus->pressure_coefficient > 0 ? kMaxExponent / barus->pressure_coefficient : kInfinity;
    return {-bound, bound};
  }
  if (const auto* roelands = std::get_if<RoelandsViscosity>(&viscosity)) {
    const double growth = std::log1p(kMaxExponent / roelands->log_ratio);
    const double bound =
        roelands->z > 0 ? std::expm1(growth / roelands->z) / kPressureScale : kInfinity;
    return {-1 / kPressureScale, bound};
  }
  return {};
}

PressureRange trusted_range(const Viscosity& viscosity) {
  switch (law_of(viscosity)) {
    case ViscosityLaw::constant:
      return {};
    case ViscosityLaw::barus:
      return {computable_range(viscosity).lowest, 0.1e9};
    case ViscosityLaw::roelands:
      return {computable_range(viscosity).lowest, 1e9};
  }
  return {};
}

}  // namespace tabor::material
