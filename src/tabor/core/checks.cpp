#include "tabor/core/checks.hpp"

#include <fmt/format.h>

#include <cmath>

#include "tabor/core/error.hpp"

namespace tabor {

void check_positive(const std::string& what, double value, const std::string& unit) {
  if (value > 0 && std::isfinite(value)) return;
  throw InputError(what, fmt::format("{}{}{}", value, unit.empty() ? "" : " ", unit),
                   "a finite value above zero", "");
}

}  // namespace tabor
