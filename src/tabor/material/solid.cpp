#include "tabor/material/solid.hpp"

#include <fmt/core.h>

#include "tabor/core/error.hpp"

namespace tabor::material {
namespace {

// Comparisons are written so that NaN fails them.
void check(const Solid& solid) {
  if (!(solid.youngs_modulus > 0)) {
    throw InputError("Young's modulus", fmt::format("{} Pa", solid.youngs_modulus),
                     "a positive pressure", "give for example 70GPa");
  }
  const double nu = solid.poissons_ratio;
  if (!(nu > -1 && nu <= 0.5)) {
    throw InputError("Poisson's ratio", fmt::format("{}", nu), "-1 < nu <= 0.5",
                     "give for example 0.33");
  }
}

/// (1 - nu^2) / E [1/Pa], 0 for a rigid solid.
double compliance(const Solid& solid) {
  check(solid);
  return (1 - solid.poissons_ratio * solid.poissons_ratio) / solid.youngs_modulus;
}

double inverse(double total_compliance) {
  if (!(total_compliance > 0)) {
    throw InputError("Young's modulus", "rigid bodies only", "at least one elastic solid",
                     "give one of them a finite modulus");
  }
  return 1 / total_compliance;
}

}  // namespace

double effective_modulus(const Solid& solid) { return inverse(compliance(solid)); }

double effective_modulus(const Solid& solid, const Solid& counter) {
  return inverse(compliance(solid) + compliance(counter));
}

}  // namespace tabor::material
