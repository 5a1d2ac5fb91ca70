#include "tabor/ehl/asperities.hpp"

#include <fmt/format.h>

#include <cmath>

#include "tabor/core/error.hpp"

namespace tabor::ehl {
namespace {

void check_not_negative(const char* what, double value, const char* unit) {
  if (!(value >= 0) || !std::isfinite(value)) {
    throw InputError(what, fmt::format("{} {}", value, unit), "zero or more", "");
  }
}

}  // namespace

void check(const Asperities& asperities) {
  check_not_negative("boundary film", asperities.boundary_film, "m");
  check_not_negative("friction coefficient of asperities", asperities.friction_coefficient, "");
  check_not_negative("shear strength of asperities", asperities.shear_strength, "Pa");
}

}  // namespace tabor::ehl
