#include "tabor/core/checks.hpp"

#include <fmt/format.h>

#include <cmath>

#include "tabor/core/error.hpp"

namespace tabor {

namespace {

void require(bool ok, const std::string& what, double value, const std::string& unit,
             const std::string& expected) {
  if (ok && std::isfinite(value)) return;
  throw InputError(what, fmt::format("{}{}{}", value, unit.empty() ? "" : " ", unit), expected, "");
}

}  // namespace

void check_positive(const std::string& what, double value, const std::string& unit) {
  require(value > 0, what, value, unit, "a finite value above zero");
}

void check_not_negative(const std::string& what, double value, const std::string& unit) {
  require(value >= 0, what, value, unit, "a finite value, zero or above");
}

}  // namespace tabor
