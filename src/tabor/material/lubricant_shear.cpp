#include "tabor/material/lubricant_shear.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "tabor/core/error.hpp"
#include "tabor/core/names.hpp"

namespace tabor::material {
namespace {

constexpr auto kLaws = names<ShearLaw>("newtonian", "ree-eyring", "limiting");

// Below this the quotients for the secant lose digits and a series has them all.
constexpr double kSmall = 1e-2;

/// f(s) and f'(s).
struct Curve {
  double value;
  double slope;
};

/// asinh(s) / s.
Curve eyring_secant(double s) {
  if (std::abs(s) < kSmall) {
    const double t = s * s;
    return {1 + t * (-1. / 6 + t * (3. / 40 - t * 5. / 112)),
            s * (-1. / 3 + t * (3. / 10 + t * (-15. / 56 + t * 35. / 144)))};
  }
  const double value = std::asinh(s) / s;
  return {value, (1 / std::hypot(1, s) - value) / s};
}

/// (1 - exp(-s)) / s, s >= 0.
Curve limiting_secant(double s) {
  if (s < kSmall) {
    return {1 + s * (-1. / 2 + s * (1. / 6 + s * (-1. / 24 + s * (1. / 120 - s / 720)))),
            -1. / 2 + s * (1. / 3 + s * (-1. / 8 + s * (1. / 30 + s * (-1. / 144 + s / 840))))};
  }
  const double value = -std::expm1(-s) / s;
  return {value, (std::exp(-s) - value) / s};
}

FlowViscosity flow(const NewtonianShear&, double viscosity, double, double) {
  return {.along = {.value = viscosity, .by_viscosity = 1},
          .across = {.value = viscosity, .by_viscosity = 1}};
}

FlowViscosity flow(const ReeEyringShear& law, double viscosity, double rate, double) {
  const double s = viscosity * rate / law.eyring_stress;
  const double root = std::hypot(1, s);
  const double cube = root * root * root;
  const double scale = viscosity * viscosity / law.eyring_stress;  // d(eta f(s)) / d(rate) / f'
  const Curve secant = eyring_secant(s);
  return {
      .along = {.value = viscosity / root, .by_viscosity = 1 / cube, .by_rate = -scale * s / cube},
      .across = {.value = viscosity * secant.value,
                 .by_viscosity = 1 / root,
                 .by_rate = scale * secant.slope}};
}

FlowViscosity flow(const LimitingShear& law, double viscosity, double rate, double pressure) {
  const double limit = law.limit_at(pressure);
  const double s = viscosity * std::abs(rate) / limit;
  const double decay = std::exp(-s);
  // The law has a kink at rest, where the mean of both sides stands.
  const double sign = rate > 0 ? 1 : (rate < 0 ? -1 : 0);
  const double scale = sign * viscosity * viscosity / limit;
  const double by_limit = pressure > 0 ? law.pressure_coefficient * viscosity * s / limit : 0;
  const Curve secant = limiting_secant(s);
  return {.along = {.value = viscosity * decay,
                    .by_viscosity = decay * (1 - s),
                    .by_rate = -scale * decay,
                    .by_pressure = by_limit * decay},
          .across = {.value = viscosity * secant.value,
                     .by_viscosity = decay,
                     .by_rate = scale * secant.slope,
                     .by_pressure = -by_limit * secant.slope}};
}

void check_stress(const char* what, double value) {
  if (!(value > 0 && std::isfinite(value))) {
    throw InputError(what, fmt::format("{} Pa", value), "a positive stress",
                     "give for example 5MPa");
  }
}

}  // namespace

double LimitingShear::limit_at(double pressure) const {
  return ambient_limit + pressure_coefficient * std::max(pressure, 0.0);
}

ReeEyringShear ree_eyring_shear(double eyring_stress) {
  check_stress("Eyring stress", eyring_stress);
  return {eyring_stress};
}

LimitingShear limiting_shear(double ambient_limit, double pressure_coefficient) {
  check_stress("limiting shear stress", ambient_limit);
  if (!(pressure_coefficient >= 0 && std::isfinite(pressure_coefficient))) {
    throw InputError("pressure coefficient of the limiting shear stress",
                     fmt::format("{}", pressure_coefficient), "zero or a positive number",
                     "give for example 0.05");
  }
  return {ambient_limit, pressure_coefficient};
}

ShearLaw parse_shear_law(std::string_view text) { return kLaws.parse(text, "shear law"); }
std::string_view name(ShearLaw law) { return kLaws.of(law); }

ShearLaw law_of(const Shear& shear) {
  return static_cast<ShearLaw>(shear.index());  // same order
}

FlowViscosity flow_viscosity(const Shear& shear, double viscosity, double rate, double pressure) {
  return std::visit([&](const auto& law) { return flow(law, viscosity, rate, pressure); }, shear);
}

ShearStress shear_stress(const Shear& shear, double viscosity, double rate, double pressure) {
  const FlowViscosity flow = flow_viscosity(shear, viscosity, rate, pressure);
  return {.value = flow.across.value * rate,
          .by_viscosity = flow.across.by_viscosity * rate,
          .by_rate = flow.along.value,
          .by_pressure = flow.across.by_pressure * rate};
}

}  // namespace tabor::material
