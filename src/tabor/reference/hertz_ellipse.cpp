#include "tabor/reference/hertz_ellipse.hpp"

#include <cassert>
#include <cmath>
#include <numbers>

namespace tabor::reference {
namespace {

/// What the complete elliptic integrals K and E of modulus e say about an ellipse of half axes 1
/// and k = sqrt(1 - e^2).
struct EllipseIntegrals {
  double first;   // K
  double wide;    // (K - E) / e^2, pi/4 for a circle
  double narrow;  // (E / k^2 - K) / e^2, pi/4 for a circle
};

/// By the arithmetic-geometric mean (Abramowitz & Stegun 17.6), without the cancellation of K - E
/// near a circle.
EllipseIntegrals ellipse_integrals(double k) {
  double a = 1;
  double g = k;
  double weight = 0.5;
  double tail = 0;  // sum of 2^(n - 1) c_n^2 from n = 1 on, over e^2
  const double e2 = (1 - k) * (1 + k);
  for (int i = 0; i < 40 && std::abs(a - g) > 1e-9 * a; ++i) {
    // c_(n+1)^2 / e^2, with (a - g) = c_n^2 / (a + g): no digits are lost where e is small.
    const double c = 0.5 * (a - g);
    const double mean = 0.5 * (a + g);
    g = std::sqrt(a * g);
    a = mean;
    weight *= 2;
    tail += weight * c * c;
  }
  const double first = 0.5 * std::numbers::pi / a;
  // E = K (1 - e^2/2 - tail).
  const double share = e2 > 0 ? tail / e2 : 0;
  return {first, first * (0.5 + share), first * (0.5 - share) / (k * k)};
}

/// Ratio of the larger principal radius to the smaller one for a ratio k of half axes (Johnson
/// 4.28): grows without bound as k falls to 0.
double radius_ratio(double k) {
  const EllipseIntegrals at = ellipse_integrals(k);
  return at.narrow / at.wide;
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
  const EllipseIntegrals at = ellipse_integrals(k);
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
