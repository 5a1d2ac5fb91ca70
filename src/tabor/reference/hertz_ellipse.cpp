#include "tabor/reference/hertz_ellipse.hpp"

#include <cassert>
#include <cmath>
#include <numbers>

#include "tabor/reference/elliptic_integrals.hpp"

namespace tabor::reference {
namespace {

/// Returns the integrals of an ellipse of half axes 1 and k.
EllipticIntegrals integrals_of(double k) {
  return elliptic_integrals(std::sqrt((1 - k) * (1 + k)), k);
}

/// Ratio of the larger principal radius to the smaller one for a ratio k of half axes (Johnson
/// 4.28): grows without bound as k falls to 0.
double radius_ratio(double k) {
  const EllipticIntegrals at = integrals_of(k);
  return at.narrow / (k * k * at.wide);
}

/// k by bisection on its logarithm.
double axis_ratio(double ratio) {
  double low = -40;
  double high = 0;
  for (int i = 0; i < 200 && high - low > 1e-16; ++i) {
    const double middle = 0.5 * (low + high);
    (radius_ratio(std::exp(middle)) > ratio ? low : high) = middle;
  }
  return std::exp(0.5 * (low + high));
}

}  // namespace

HertzEllipse hertz_ellipse_at_load(double radius_x, double radius_y, double effective_modulus,
                                   double load) {
  assert(radius_x > 0 && radius_y > 0 && effective_modulus > 0 && load >= 0);
  const bool wide_in_x = radius_x >= radius_y;
  const double larger = wide_in_x ? radius_x : radius_y;
  const double smaller = wide_in_x ? radius_y : radius_x;
  const double k = larger == smaller ? 1 : axis_ratio(larger / smaller);
  const EllipticIntegrals at = integrals_of(k);
  // 1/(2 R) = p0 b wide / (E* a^2) with R the larger radius, b = k a and p0 = 3 F/(2 pi a b).
  const double a = std::cbrt(3 * load * larger * at.wide / (std::numbers::pi * effective_modulus));
  const double b = k * a;
  HertzEllipse contact{.radius_x = radius_x,
                       .radius_y = radius_y,
                       .effective_modulus = effective_modulus,
                       .load = load,
                       .half_axis_x = wide_in_x ? a : b,
                       .half_axis_y = wide_in_x ? b : a};
  if (load > 0) contact.max_pressure = 1.5 * load / (std::numbers::pi * a * b);
  contact.approach = contact.max_pressure * b * at.first / effective_modulus;
  return contact;
}

double hertz_pressure(const HertzEllipse& contact, double x, double y) {
  const double u = x / contact.half_axis_x;
  const double v = y / contact.half_axis_y;
  const double inside = 1 - u * u - v * v;
  return inside > 0 ? contact.max_pressure * std::sqrt(inside) : 0;
}

}  // namespace tabor::reference
