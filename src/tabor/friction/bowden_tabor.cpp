#include "tabor/friction/bowden_tabor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tabor/core/checks.hpp"
#include "tabor/core/error.hpp"
#include "tabor/core/text.hpp"
#include "tabor/core/units.hpp"

namespace tabor::friction {
namespace {

/// A share may exceed its bounds by rounding alone; NaN is rejected too.
void check_share(double value, const std::string& what) {
  if (!(value >= 0 && value <= 1 + 1e-12)) {
    throw InputError(what, fmt::format("{}", value), "a share between 0 and 1", "");
  }
}

/// What the corrected area is never taken below; 0 without saturation.
double least_area_fraction(const Contact& contact) {
  return contact.mean_pressure / contact.saturation_pressure;
}

}  // namespace

std::string_view name(Area area) { return kAreas.of(area); }

std::string_view words_of(Area area) {
  return area == Area::corrected ? "contact area" : "counted contact";
}

Area parse_area(std::string_view text) { return kAreas.parse(text, "area"); }

Estimate estimate(const Contact& contact, double shear_strength, Area area,
                  double boundary_shear_strength) {
  check_positive("mean pressure", contact.mean_pressure, "Pa");
  check_positive("shear strength", shear_strength, "Pa");
  if (!(contact.saturation_pressure > 0)) {
    check_positive("saturation pressure", contact.saturation_pressure, "Pa");
  }
  if (!(boundary_shear_strength >= 0 && boundary_shear_strength <= shear_strength)) {
    throw InputError("boundary shear strength", format_si(boundary_shear_strength, "Pa"),
                     "zero to the shear strength, " + format_si(shear_strength, "Pa"), "");
  }
  check_share(contact.contact_area_fraction, "contact area fraction");
  check_share(contact.contact_area_fraction_pixels, "contact area fraction in pixels");
  check_share(contact.lubricated_share, "lubricated share");
  const double least = least_area_fraction(contact);
  const double corrected = std::max(contact.contact_area_fraction, least);
  const bool corrected_at_bound = least > 0 && corrected <= least * (1 + 1e-12);
  const double fraction = area == Area::pixels ? contact.contact_area_fraction_pixels : corrected;
  const double dry = fraction * shear_strength / contact.mean_pressure;
  const double slippery = 1 - boundary_shear_strength / shear_strength;
  return {.area_fraction = fraction,
          .area = area,
          .friction_dry = dry,
          .friction_lubricated = (1 - std::min(contact.lubricated_share, 1.0) * slippery) * dry,
          .at_bound = corrected_at_bound && area == Area::corrected,
          .corrected_at_bound = corrected_at_bound};
}

}  // namespace tabor::friction
