#include "tabor/reference/hertz.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "reference/quadrature.hpp"

namespace tabor::reference {
namespace {

const HertzContact kContact = hertz_at_load(10e-3, 115e9, 30.0);

TEST(Hertz, PressureIntegratesToTheLoad) {
  const double load =
      integral_over_disc(kContact.radius, [](double r) { return hertz_pressure(kContact, r); });
  EXPECT_NEAR(load / kContact.load, 1, 1e-8);
}

TEST(Hertz, ApproachGivesBackTheLoad) {
  const auto same = hertz_at_approach(10e-3, 115e9, kContact.approach);
  EXPECT_NEAR(kContact.load, 30.0, 1e-12);
  EXPECT_DOUBLE_EQ(same.load, kContact.load);
  EXPECT_DOUBLE_EQ(same.max_pressure, kContact.max_pressure);
}

TEST(Hertz, MeanPressureIsTwoThirdsOfTheLargest) {
  const double area = std::numbers::pi * kContact.radius * kContact.radius;
  EXPECT_NEAR(kContact.load / area, 2.0 / 3.0 * kContact.max_pressure,
              1e-12 * kContact.max_pressure);
}

TEST(Hertz, LoadIsTheDerivativeOfTheElasticEnergy) {
  // F = dU/d(delta) with U = (2/5) F delta for F ~ delta^(3/2): checked by integrating F.
  double energy = 0;
  const int n = 20000;
  for (int k = 0; k < n; ++k) {
    const double approach = kContact.approach * (k + 0.5) / n;
    energy += hertz_at_approach(10e-3, 115e9, approach).load * kContact.approach / n;
  }
  EXPECT_NEAR(energy / (0.4 * kContact.load * kContact.approach), 1, 1e-8);
}

TEST(Hertz, DisplacementAtTheCentreIsThatOfThePressure) {
  // Boussinesq: u(0) = integral of p / (pi E* r) over the contact.
  const double u = integral_over_disc(kContact.radius, [](double r) {
    return hertz_pressure(kContact, r) / (std::numbers::pi * kContact.effective_modulus * r);
  });
  EXPECT_NEAR(u / hertz_displacement(kContact, 0), 1, 1e-8);
}

TEST(Hertz, DisplacementIsContinuousAtTheEdge) {
  const double a = kContact.radius;
  EXPECT_NEAR(hertz_displacement(kContact, a * (1 - 1e-12)),
              hertz_displacement(kContact, a * (1 + 1e-12)), 1e-9 * kContact.approach);
}

TEST(Hertz, FarDisplacementIsThatOfAPointForce) {
  const double r = 100 * kContact.radius;
  const double point = kContact.load / (std::numbers::pi * kContact.effective_modulus * r);
  EXPECT_NEAR(hertz_displacement(kContact, r) / point, 1, 1e-4);
}

TEST(Hertz, NoLoadTouchesNothing) {
  const auto nothing = hertz_at_load(10e-3, 115e9, 0);
  EXPECT_EQ(nothing.radius, 0);
  EXPECT_EQ(nothing.max_pressure, 0);
  EXPECT_EQ(hertz_pressure(nothing, 0), 0);
}

}  // namespace
}  // namespace tabor::reference
