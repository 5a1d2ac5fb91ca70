#include "tabor/reference/impact.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/worst.hpp"
#include "tabor/reference/hertz.hpp"

namespace tabor::reference {
namespace {

// A steel ball of 12.7 mm radius dropped at 0.313 m/s; E' = 2 E* = 110 GPa.
const DryImpact kBall = hertz_impact(0.0127, 55e9, 0.066, 0.313);

// Worked outside tabor from Johnson's formulas.
TEST(HertzImpact, OfTheDroppedBallHasItsKnownNumbers) {
  EXPECT_NEAR(kBall.contact_time, 147.7e-6, 0.2e-6);
  EXPECT_NEAR(kBall.max_approach, 15.709e-6, 0.0005e-6);
  EXPECT_NEAR(kBall.max_force, 515, 1);
}

TEST(HertzImpact, TurnsAllKineticEnergyIntoElasticEnergy) {
  // Work of F ~ delta^(3/2) up to the deepest point: (2/5) F delta.
  EXPECT_NEAR(0.4 * kBall.max_force * kBall.max_approach / (0.5 * kBall.mass * 0.313 * 0.313), 1,
              1e-12);
}

TEST(HertzImpact, DeepestPointIsAHertzContact) {
  const auto contact = hertz_at_load(0.0127, 55e9, kBall.max_force);
  EXPECT_NEAR(contact.approach / kBall.max_approach, 1, 1e-12);
  EXPECT_NEAR(contact.radius / kBall.max_radius, 1, 1e-12);
  EXPECT_NEAR(contact.max_pressure / kBall.max_pressure, 1, 1e-12);
}

/// The motion m x'' = -F(x) by small steps (velocity Verlet): contact time, and the largest
/// distance from the sine.
struct Motion {
  double contact_time = 0;
  double distance_from_sine = 0;
};
Motion integrated(const DryImpact& impact, int n_steps) {
  const double dt = impact.contact_time / n_steps;
  const auto acceleration = [&](double x) {
    return -hertz_at_approach(impact.sphere_radius, impact.effective_modulus, std::max(x, 0.0))
                .load /
           impact.mass;
  };
  Motion motion;
  double x = 0, v = impact.speed, a = 0;
  for (int i = 1; i < 2 * n_steps; ++i) {
    const double before = x;
    x += v * dt + 0.5 * a * dt * dt;
    if (x <= 0) {
      motion.contact_time = dt * (i - 1 + before / (before - x));
      break;
    }
    const double next = acceleration(x);
    v += 0.5 * (a + next) * dt;
    a = next;
    motion.distance_from_sine =
        test::worse(motion.distance_from_sine, std::abs(x - impact.approach_at(i * dt)));
  }
  return motion;
}

TEST(HertzImpact, LastsAsLongAsTheIntegratedMotion) {
  const Motion motion = integrated(kBall, 20000);
  EXPECT_NEAR(motion.contact_time / kBall.contact_time, 1, 1e-6);
  EXPECT_LE(motion.distance_from_sine, 0.022 * kBall.max_approach);
  EXPECT_GE(motion.distance_from_sine, 0.001 * kBall.max_approach);
}

// Groups of R, E' and eta0 (which cancels): D = 1.2859 M^0.4 V^0.8, W = 0.9721 M^0.6 V^1.2,
// P = 0.3610 M^0.2 V^0.4.
TEST(HertzImpact, HasTheDimensionlessFormOfTheImpactMaps) {
  const double R = 10e-3, E = 230e9, eta0 = 0.1, m = 32.5e-3, v = 0.2;
  const DryImpact impact = hertz_impact(R, E / 2, m, v);
  const double M = m * E / (R * eta0 * eta0);
  const double V = eta0 * v / (E * R);
  EXPECT_NEAR(M, 7.475e13, 1e9);
  EXPECT_NEAR(V, 8.696e-12, 1e-15);
  EXPECT_NEAR(impact.max_approach / R / (std::pow(M, 0.4) * std::pow(V, 0.8)), 1.2859, 5e-5);
  EXPECT_NEAR(impact.max_force / (E * R * R) / (std::pow(M, 0.6) * std::pow(V, 1.2)), 0.9721, 5e-5);
  EXPECT_NEAR(impact.max_pressure / E / (std::pow(M, 0.2) * std::pow(V, 0.4)), 0.3610, 5e-5);
}

TEST(HertzImpact, TouchesNothingBeforeAndAfter) {
  EXPECT_EQ(kBall.force_at(-1e-6), 0);
  EXPECT_EQ(kBall.force_at(1.01 * kBall.contact_time), 0);
  EXPECT_NEAR(kBall.force_at(0.5 * kBall.contact_time), kBall.max_force, 1e-9);
}

}  // namespace
}  // namespace tabor::reference
