#include "tabor/reference/squeeze.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "reference/quadrature.hpp"

namespace tabor::reference {
namespace {

using std::numbers::pi;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(SphereSqueeze, UnboundedIsTaylorsForce) {
  const SphereSqueeze sphere{10e-3, 0.1, kInfinity};
  EXPECT_NEAR(sphere.force(1e-6, 0.2) / (6 * pi * 0.1 * 1e-4 * 0.2 / 1e-6), 1, 1e-14);
}

TEST(SphereSqueeze, PressureIntegratesToTheForce) {
  const SphereSqueeze sphere{10e-3, 0.1, 50e-6};
  const double h0 = 5e-6;
  const double wetted = std::sqrt(2 * 10e-3 * (50e-6 - h0));
  const double force = integral_over_disc(
      wetted, [&](double r) { return sphere.pressure(h0 + r * r / (2 * 10e-3), 0.2); });
  EXPECT_NEAR(force / sphere.force(h0, 0.2), 1, 1e-6);
  EXPECT_NEAR(sphere.pressure(50e-6, 0.2), 0, 1e-9);
  EXPECT_EQ(sphere.force(50e-6, 0.2), 0);
}

TEST(SphereSqueeze, PressureDrivesOutWhatTheApproachDisplaces) {
  const SphereSqueeze sphere{10e-3, 0.1, 50e-6};
  const double h0 = 5e-6, v = 0.2;
  for (const double r : {1e-4, 3e-4, 8e-4}) {
    const auto p = [&](double x) { return sphere.pressure(h0 + x * x / (2 * 10e-3), v); };
    const double h = h0 + r * r / (2 * 10e-3);
    const double slope = (p(r + 1e-8) - p(r - 1e-8)) / 2e-8;
    EXPECT_NEAR(-2 * pi * r * h * h * h / (12 * 0.1) * slope / (pi * r * r * v), 1, 1e-6);
  }
}

TEST(CylinderSqueeze, PressureIntegratesToTheForce) {
  const CylinderSqueeze cylinder{9.2e-3, 0.5};
  const double h0 = 4e-6;
  const double length = std::sqrt(2 * 9.2e-3 * h0);
  const int n = 20000;
  double force = 0;
  for (int i = 0; i < n; ++i) {
    const double t = pi * ((i + 0.5) / n - 0.5);
    const double stretch = length / (std::cos(t) * std::cos(t));
    force += cylinder.pressure(h0 / (std::cos(t) * std::cos(t)), 0.25) * stretch * pi / n;
  }
  EXPECT_NEAR(force / cylinder.force(h0, 0.25), 1, 1e-8);
}

TEST(DiscSqueeze, PressureIntegratesToTheForceOfStefan) {
  const DiscSqueeze disc{5e-3, 0.3};
  const double force =
      integral_over_disc(5e-3, [&](double r) { return disc.pressure(r, 1e-5, 1e-3); });
  EXPECT_NEAR(force / disc.force(1e-5, 1e-3), 1, 1e-8);
}

TEST(DiscSqueeze, ClosesInTheTimeOfItsSpeed) {
  const DiscSqueeze disc{5e-3, 0.3};
  const double film = 1e-5, step = 1e-10;
  const double time = disc.closing_time(10, film + step, film - step);
  EXPECT_NEAR(disc.force(film, 2 * step / time) / 10, 1, 1e-6);
}

TEST(BallApproach, LosesSpeedToTheWorkOfTheFilm) {
  const BallApproach ball{10e-3, 32.5e-3, 0.1};
  const double from = 50e-6, v = 0.2;
  const SphereSqueeze film{10e-3, 0.1, kInfinity};
  for (const double h : {40e-6, 10e-6, 3e-6}) {
    const double slope =
        (ball.speed_at(h * 1.0001, from, v) - ball.speed_at(h * 0.9999, from, v)) / (2e-4 * h);
    const double speed = ball.speed_at(h, from, v);
    EXPECT_NEAR(32.5e-3 * speed * slope / film.force(h, speed), 1, 1e-6) << h;
  }
}

TEST(BallApproach, StopsAtTheGapOfItsStokesNumber) {
  const BallApproach ball{10e-3, 32.5e-3, 0.1};
  const double stokes = ball.stokes_number(0.01);
  EXPECT_NEAR(stokes, 32.5e-3 * 0.01 / (6 * pi * 0.1 * 1e-4), 1e-12);
  const double gap = ball.stopping_gap(50e-6, 0.01);
  EXPECT_NEAR(gap, 50e-6 * std::exp(-stokes), 1e-18);
  EXPECT_GT(ball.speed_at(1.001 * gap, 50e-6, 0.01), 0);
  EXPECT_EQ(ball.speed_at(0.999 * gap, 50e-6, 0.01), 0);
}

}  // namespace
}  // namespace tabor::reference
