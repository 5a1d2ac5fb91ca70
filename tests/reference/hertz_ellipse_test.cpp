#include "tabor/reference/hertz_ellipse.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tabor/reference/hertz.hpp"

namespace tabor::reference {
namespace {

constexpr double kModulus = 1.1e11;
constexpr double kLoad = 50;

TEST(HertzEllipse, IsHertzCircleForABall) {
  const HertzEllipse ellipse = hertz_ellipse_at_load(0.01, 0.01, kModulus, kLoad);
  const HertzContact circle = hertz_at_load(0.01, kModulus, kLoad);
  EXPECT_NEAR(ellipse.half_axis_x / circle.radius, 1, 1e-14);
  EXPECT_NEAR(ellipse.half_axis_y / circle.radius, 1, 1e-14);
  EXPECT_NEAR(ellipse.approach / circle.approach, 1, 1e-14);
  EXPECT_NEAR(ellipse.max_pressure / circle.max_pressure, 1, 1e-14);
}

TEST(HertzEllipse, TendsToTheCircleWithoutLosingDigits) {
  const HertzEllipse nearly = hertz_ellipse_at_load(0.01, 0.01 * (1 + 1e-6), kModulus, kLoad);
  const HertzContact circle = hertz_at_load(0.01, kModulus, kLoad);
  EXPECT_NEAR(nearly.half_axis_x / circle.radius, 1, 1e-6);
  EXPECT_NEAR(nearly.half_axis_y / nearly.half_axis_x, 1 + 2e-6 / 3, 1e-6);
}

TEST(HertzEllipse, TurnsWithItsRadii) {
  const HertzEllipse a = hertz_ellipse_at_load(0.01, 0.05, kModulus, kLoad);
  const HertzEllipse b = hertz_ellipse_at_load(0.05, 0.01, kModulus, kLoad);
  EXPECT_EQ(a.half_axis_x, b.half_axis_y);
  EXPECT_EQ(a.half_axis_y, b.half_axis_x);
  EXPECT_GT(a.half_axis_y, a.half_axis_x);
  EXPECT_EQ(a.approach, b.approach);
}

/// Integral over w from 0 to infinity of dw / sqrt(w (a^2 + w)^k (b^2 + w)^m), with w = (a tan
/// t)^2.
double ellipsoid_integral(double a, double b, int k, int m) {
  constexpr int kSteps = 20000;
  const double step = 0.5 * std::numbers::pi / kSteps;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double t = (i + 0.5) * step;
    const double tangent = a * std::tan(t);
    const double w = tangent * tangent;
    const double by_t = 2 * a / (std::cos(t) * std::cos(t));  // dw/dt / sqrt(w)
    sum += by_t / std::sqrt(std::pow(a * a + w, k) * std::pow(b * b + w, m));
  }
  return sum * step;
}

/// Under p0 sqrt(1 - x^2/a^2 - y^2/b^2) the surface moves by
/// p0 a b/(2 E*) integral (1 - x^2/(a^2 + w) - y^2/(b^2 + w)) dw / sqrt(w (a^2 + w) (b^2 + w)).
TEST(HertzEllipse, ItsPressureFlattensTheBodies) {
  for (const double ratio : {1.5, 5.0, 40.0}) {
    const HertzEllipse at = hertz_ellipse_at_load(0.01, 0.01 * ratio, kModulus, kLoad);
    const double a = at.half_axis_x;
    const double b = at.half_axis_y;
    const double scale = at.max_pressure * a * b / (2 * kModulus);
    const double errors[] = {scale * ellipsoid_integral(a, b, 3, 1) * 2 * at.radius_x - 1,
                             scale * ellipsoid_integral(a, b, 1, 3) * 2 * at.radius_y - 1,
                             scale * ellipsoid_integral(a, b, 1, 1) / at.approach - 1,
                             2 * std::numbers::pi / 3 * a * b * at.max_pressure / kLoad - 1};
    for (const double error : errors) {
      EXPECT_LE(std::abs(error), 1e-9);
    }
  }
}

TEST(HertzEllipse, PressureIsAnEllipsoid) {
  const HertzEllipse at = hertz_ellipse_at_load(0.01, 0.03, kModulus, kLoad);
  EXPECT_EQ(hertz_pressure(at, 0, 0), at.max_pressure);
  EXPECT_EQ(hertz_pressure(at, at.half_axis_x, 0), 0);
  EXPECT_NEAR(hertz_pressure(at, 0, 0.6 * at.half_axis_y), 0.8 * at.max_pressure,
              1e-12 * at.max_pressure);
}

}  // namespace
}  // namespace tabor::reference
