#include "tabor/reference/hertz_line.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tabor/reference/hertz.hpp"

namespace tabor::reference {
namespace {

// HDPE on steel: 5000 N/m, R = 2.5 mm, E = 1.05 GPa, nu = 0.35.
const HertzLineContact kContact = hertz_line_at_load(2.5e-3, 1.05e9 / (1 - 0.35 * 0.35), 5000);

TEST(HertzLine, OfThePolymerPinHasItsKnownNumbers) {
  EXPECT_NEAR(kContact.half_width, 115.3e-6, 0.05e-6);
  EXPECT_NEAR(kContact.max_pressure, 27.6e6, 0.05e6);
}

/// Sum over the contact of weight(x) p(x), by x = b sin(t).
template <typename Weight>
double integral(const Weight& weight) {
  const int n = 20000;
  double sum = 0;
  for (int i = 0; i < n; ++i) {
    const double t = std::numbers::pi * ((i + 0.5) / n - 0.5);
    const double x = kContact.half_width * std::sin(t);
    sum += weight(x) * kContact.pressure(x) * std::cos(t);
  }
  return sum * std::numbers::pi / n * kContact.half_width;
}

TEST(HertzLine, PressureIntegratesToTheLoad) {
  EXPECT_NEAR(integral([](double) { return 1; }) / 5000, 1, 1e-8);
}

TEST(HertzLine, DisplacementIsThatOfThePressure) {
  // u(x) = -(2 / (pi E*)) integral p ln(|x - s| / datum) ds, outside the contact, where it is
  // smooth.
  const double datum = 1e-3;
  for (const double x : {1.2 * kContact.half_width, 3e-4, 2e-3}) {
    const double expected = -2 / (std::numbers::pi * kContact.effective_modulus) *
                            integral([&](double s) { return std::log(std::abs(x - s) / datum); });
    EXPECT_NEAR(kContact.displacement(x, datum), expected, 1e-7 * kContact.displacement(0, datum));
  }
}

TEST(HertzLine, GapOpensContinuouslyAndTendsToTheCylinder) {
  const double b = kContact.half_width;
  EXPECT_EQ(kContact.gap(0.99 * b), 0);
  EXPECT_NEAR(kContact.gap(1.0001 * b), 0, 1e-5 * b * b / 2.5e-3);
  const double far = 1000 * b;
  EXPECT_NEAR(kContact.gap(far) / (far * far / (2 * 2.5e-3)), 1, 1e-4);
}

TEST(HertzGap, IsTheSphereLessTheApproachPlusTheDisplacement) {
  const HertzContact sphere = hertz_at_load(10e-3, 115e9, 30);
  for (const double q : {0.5, 1.0, 1.1, 2.0, 30.0}) {
    const double r = q * sphere.radius;
    const double expected = r * r / (2 * 10e-3) - sphere.approach + hertz_displacement(sphere, r);
    EXPECT_NEAR(hertz_gap(10e-3, sphere.radius, r), expected, 1e-12 * r * r / 10e-3) << q;
  }
}

}  // namespace
}  // namespace tabor::reference
