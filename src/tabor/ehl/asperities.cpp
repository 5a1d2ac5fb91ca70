#include "tabor/ehl/asperities.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "tabor/core/error.hpp"

namespace tabor::ehl {
namespace {

void check_not_negative(const char* what, double value, const char* unit) {
  if (!(value >= 0) || !std::isfinite(value)) {
    throw InputError(what, fmt::format("{} {}", value, unit), "zero or more", "");
  }
}

}  // namespace

double Asperities::friction(double carried, double area) const {
  if (carried == 0 && area == 0) return 0;
  if (!has_friction()) return std::numeric_limits<double>::quiet_NaN();
  return friction_coefficient.value_or(0) * carried + shear_strength.value_or(0) * area;
}

void check(const Asperities& asperities) {
  check_not_negative("boundary film", asperities.boundary_film, "m");
  check_not_negative("friction coefficient of asperities",
                     asperities.friction_coefficient.value_or(0), "");
  check_not_negative("shear strength of asperities", asperities.shear_strength.value_or(0), "Pa");
}

}  // namespace tabor::ehl
