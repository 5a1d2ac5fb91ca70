#include "tabor/core/checks.hpp"

#include <fmt/format.h>

#include <cmath>

#include "tabor/core/error.hpp"
#include "tabor/core/resources.hpp"

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

void check_memory(const std::string& what, const std::string& got, double bytes,
                  const std::string& remedy) {
  constexpr double kAlwaysFree = 1e8;  // too little to ask for
  if (bytes < kAlwaysFree) return;
  const auto available = static_cast<double>(available_memory_bytes());
  if (available == 0 || bytes <= available) return;
  throw InputError(what, fmt::format("{}, which take {:.2g} GB", got, bytes * 1e-9),
                   fmt::format("what fits into the {:.2g} GB of free memory", available * 1e-9),
                   remedy);
}

}  // namespace tabor
