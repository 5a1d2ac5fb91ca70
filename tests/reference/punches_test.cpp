#include "tabor/reference/punches.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "reference/quadrature.hpp"

namespace tabor::reference {
namespace {

constexpr double kModulus = 70e9;

/// Boussinesq: displacement at the centre under an axisymmetric pressure.
template <typename Pressure>
double displacement_at_centre(double a, const Pressure& pressure) {
  return integral_over_disc(
      a, [&](double r) { return pressure(r) / (std::numbers::pi * kModulus * r); });
}

TEST(FlatPunch, PressureIntegratesToTheLoad) {
  const FlatPunch punch{1e-3, kModulus};
  const double d = 2e-6;
  const double load =
      integral_over_disc(punch.radius, [&](double r) { return punch.pressure(d, r); });
  EXPECT_NEAR(load / punch.load(d), 1, 1e-6);
}

TEST(FlatPunch, PressureDisplacesTheCentreByTheIndentation) {
  const FlatPunch punch{1e-3, kModulus};
  const double d = 2e-6;
  const double u =
      displacement_at_centre(punch.radius, [&](double r) { return punch.pressure(d, r); });
  EXPECT_NEAR(u / d, 1, 1e-6);
}

TEST(Cone, PressureIntegratesToTheLoad) {
  const Cone cone{0.05, kModulus};
  const double a = cone.contact_radius(10.0);
  const double load = integral_over_disc(a, [&](double r) { return cone.pressure(a, r); });
  EXPECT_NEAR(load / 10.0, 1, 1e-6);
}

TEST(Cone, PressureDisplacesTheCentreByTheIndentation) {
  const Cone cone{0.05, kModulus};
  const double a = 1e-5;
  const double u = displacement_at_centre(a, [&](double r) { return cone.pressure(a, r); });
  EXPECT_NEAR(u / cone.indentation(a), 1, 1e-3);
}

TEST(Cone, LoadGrowsWithTheSquareOfTheContactRadius) {
  const Cone cone{0.05, kModulus};
  EXPECT_NEAR(cone.contact_radius(40.0), 2 * cone.contact_radius(10.0), 1e-15);
}

}  // namespace
}  // namespace tabor::reference
