#include "tabor/reference/bearings.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "reference/quadrature.hpp"

namespace tabor::reference {
namespace {

constexpr CylinderFilm kCylinder{
    .radius = 10e-3, .min_film = 1e-6, .entrainment_speed = 0.5, .viscosity = 0.1};

/// Midpoint rule.
template <typename Function>
double integral(double from, double to, const Function& f, int n = 200000) {
  const double step = (to - from) / n;
  double sum = 0;
  for (int i = 0; i < n; ++i) sum += f(from + (i + 0.5) * step);
  return sum * step;
}

/// Volume flow u h - h^3 p' / (12 eta), u the mean wall speed.
template <typename Pressure, typename Film>
double flow(const Pressure& p, const Film& h, double x, double step, double u, double viscosity) {
  const double slope = (p(x + step) - p(x - step)) / (2 * step);
  return u * h(x) - std::pow(h(x), 3) / (12 * viscosity) * slope;
}

TEST(Martin, HasItsKnownNumbers) {
  EXPECT_NEAR(martin_exit_angle(), 0.44355, 5e-6);
  EXPECT_NEAR(kCylinder.martin_load() / (0.1 * 0.5 * 10e-3 / 1e-6), 4.8950, 5e-5);
  EXPECT_NEAR(kCylinder.martin_exit() / std::sqrt(2 * 10e-3 * 1e-6), 0.47513, 5e-6);
}

TEST(Martin, PressureConservesTheFlow) {
  const auto p = [](double x) { return kCylinder.martin_pressure(x); };
  const auto h = [](double x) { return kCylinder.film(x); };
  const double carried = 0.5 * kCylinder.film(kCylinder.martin_exit());
  for (const double x : {-1e-3, -3e-4, -1e-4, 0.0, 5e-5}) {
    EXPECT_NEAR(flow(p, h, x, 1e-8, 0.5, 0.1) / carried, 1, 1e-6) << x;
  }
}

TEST(Martin, PressureAndItsSlopeEndAtTheExit) {
  const double exit = kCylinder.martin_exit();
  const double peak = kCylinder.martin_pressure(-exit);
  EXPECT_NEAR(kCylinder.martin_pressure(exit * (1 - 1e-9)) / peak, 0, 1e-8);
  EXPECT_NEAR(kCylinder.martin_pressure(exit * 0.999) / peak, 0, 1e-5);
  EXPECT_EQ(kCylinder.martin_pressure(exit * 1.001), 0);
  EXPECT_NEAR(kCylinder.martin_pressure(-1.0) / peak, 0, 1e-6);
}

TEST(Martin, PressureIntegratesToTheLoad) {
  const double load = integral(
      -0.2, kCylinder.martin_exit(), [](double x) { return kCylinder.martin_pressure(x); }, 800000);
  EXPECT_NEAR(load / kCylinder.martin_load(), 1, 1e-5);
}

TEST(Sommerfeld, PressureConservesTheFlowAndHalfOfItCarries) {
  const auto p = [](double x) { return kCylinder.sommerfeld_pressure(x); };
  const auto h = [](double x) { return kCylinder.film(x); };
  for (const double x : {-1e-3, -1e-4, 0.0, 2e-4}) {
    EXPECT_NEAR(flow(p, h, x, 1e-8, 0.5, 0.1) / (0.5 * 4. / 3 * 1e-6), 1, 1e-6) << x;
  }
  EXPECT_NEAR(integral(-0.1, 0, p, 800000) / kCylinder.half_sommerfeld_load(), 1, 1e-5);
}

TEST(Kapitza, SphereHasItsKnownLoad) {
  const KapitzaFilm sphere{10e-3, 10e-3, 1e-6, 0.5, 0.1};
  const double scale = 0.1 * 0.5 * std::pow(10e-3, 1.5) / std::sqrt(1e-6);
  EXPECT_NEAR(sphere.load() / scale, 10.6629, 5e-5);
  EXPECT_NEAR(sphere.film_at_load(sphere.load()), 1e-6, 1e-18);
  EXPECT_NEAR(sphere.film_at_load(2 * sphere.load()), 0.25e-6, 1e-18);
}

TEST(Kapitza, PressureSolvesReynoldsEquation) {
  // div(h^3 grad p) = 12 eta u dh/dx, for an ellipsoid, by differences.
  const KapitzaFilm body{10e-3, 30e-3, 1e-6, 0.5, 0.1};
  const double step = 1e-7;
  const auto face = [&](double x, double y, double dx, double dy) {
    const double h = body.film(x + 0.5 * dx, y + 0.5 * dy);
    return h * h * h * (body.pressure(x + dx, y + dy) - body.pressure(x, y)) / step;
  };
  for (const auto& [x, y] : {std::pair{-1e-4, 2e-4}, {-3e-4, 0.0}, {1e-4, -1e-4}}) {
    const double divergence =
        (face(x, y, step, 0) + face(x, y, -step, 0) + face(x, y, 0, step) + face(x, y, 0, -step)) /
        step;
    EXPECT_NEAR(divergence / (12 * 0.1 * 0.5 * x / 10e-3), 1, 1e-5);
  }
}

TEST(Kapitza, PressureIntegratesToTheLoad) {
  const KapitzaFilm body{10e-3, 30e-3, 1e-6, 0.5, 0.1};
  // x = sqrt(2 h0 Rx) tan(s), y = sqrt(2 h0 Ry) tan(t) gathers the plane.
  const double lx = std::sqrt(2 * 1e-6 * 10e-3), ly = std::sqrt(2 * 1e-6 * 30e-3);
  const int n = 2000;
  double load = 0;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const double s = -0.5 * std::numbers::pi * (i + 0.5) / n;
      const double t = std::numbers::pi * ((j + 0.5) / n - 0.5);
      const double stretch = lx * ly / std::pow(std::cos(s) * std::cos(t), 2);
      load += body.pressure(lx * std::tan(s), ly * std::tan(t)) * stretch;
    }
  }
  load *= 0.5 * std::pow(std::numbers::pi / n, 2);
  EXPECT_NEAR(load / body.load(), 1, 1e-3);
}

TEST(LinearSlider, CarriesMostAtItsKnownRatio) {
  const double scale = 0.1 * 1.0 * 4e-4 / 4e-12;
  const auto load = [&](double K) {
    return LinearSlider{0.02, 2e-6 * (1 + K), 2e-6, 1.0, 0.1}.load() / scale;
  };
  EXPECT_NEAR(load(1.1889), 0.16024, 5e-6);
  EXPECT_GT(load(1.1889), load(1.18));
  EXPECT_GT(load(1.1889), load(1.20));
}

TEST(LinearSlider, PressureConservesTheFlowAndIntegratesToTheLoad) {
  const LinearSlider slider{0.02, 5e-6, 2e-6, 1.0, 0.1};
  const auto p = [&](double x) { return slider.pressure(x); };
  const auto h = [&](double x) { return 5e-6 - 3e-6 * x / 0.02; };
  EXPECT_EQ(p(0), 0);
  EXPECT_NEAR(p(0.02), 0, 1e-6);
  const double carried = flow(p, h, 0.01, 1e-6, 0.5, 0.1);
  for (const double x : {0.001, 0.005, 0.019}) {
    EXPECT_NEAR(flow(p, h, x, 1e-6, 0.5, 0.1) / carried, 1, 1e-6);
  }
  EXPECT_NEAR(integral(0, 0.02, p) / slider.load(), 1, 1e-8);
}

TEST(RayleighStep, CarriesMostAtItsKnownShape) {
  const double scale = 0.1 * 1.0 * 4e-4 / 4e-12;
  const auto load = [&](double ratio, double place) {
    return RayleighStep{0.02, place * 0.02, 2e-6 * ratio, 2e-6, 1.0, 0.1}.load() / scale;
  };
  EXPECT_NEAR(load(1.866, 0.7182), 0.2063, 5e-5);
  for (const double ratio : {1.84, 1.89}) {
    EXPECT_GT(load(1.866, 0.7182), load(ratio, 0.7182));
  }
  for (const double place : {0.70, 0.735}) {
    EXPECT_GT(load(1.866, 0.7182), load(1.866, place));
  }
}

TEST(RayleighStep, FlowsTheSameBeforeAndBehindTheStep) {
  const RayleighStep step{0.02, 0.014, 4e-6, 2e-6, 1.0, 0.1};
  const auto p = [&](double x) { return step.pressure(x); };
  const auto h = [&](double x) { return x < 0.014 ? 4e-6 : 2e-6; };
  EXPECT_NEAR(flow(p, h, 0.005, 1e-6, 0.5, 0.1) / flow(p, h, 0.018, 1e-6, 0.5, 0.1), 1, 1e-9);
  EXPECT_NEAR(integral(0, 0.02, p) / step.load(), 1, 1e-8);
}

constexpr CavitatedPocket kPocket{.length = 20e-3,
                                  .begin = 4e-3,
                                  .end = 8e-3,
                                  .land_film = 1e-6,
                                  .pocket_film = 2e-6,
                                  .sliding_speed = 1,
                                  .viscosity = 0.01,
                                  .ambient_pressure = 1e5,
                                  .cavity_pressure = 0};

TEST(CavitatedPocket, HasItsKnownNumbers) {
  EXPECT_NEAR(kPocket.flow(), 5.002083e-7, 5e-14);
  EXPECT_NEAR(kPocket.fill(), 0.500208, 5e-7);
  EXPECT_NEAR(kPocket.end_pressure(), 4e5, 1e-6);
  EXPECT_NEAR(kPocket.reformation(), 7.946644e-3, 1e-9);
  EXPECT_NEAR(kPocket.load(), 3210.671, 5e-4);
}

TEST(CavitatedPocket, FlowsTheSameEverywhere) {
  CavitatedPocket pocket = kPocket;
  pocket.cavity_pressure = 2e4;
  const auto p = [&](double x) { return pocket.pressure(x); };
  const auto h = [&](double x) { return x > pocket.begin && x < pocket.end ? 2e-6 : 1e-6; };
  for (const double x : {2e-3, 0.5 * (pocket.reformation() + pocket.end), 15e-3}) {
    EXPECT_NEAR(flow(p, h, x, 1e-8, 0.5, 0.01) / pocket.flow(), 1, 1e-8) << x;
  }
  const double in_cavity = 0.5 * pocket.fill() * 2e-6;
  EXPECT_NEAR(in_cavity / pocket.flow(), 1, 1e-14);
}

TEST(CavitatedPocket, PressureIntegratesToTheLoad) {
  const double load = integral(
      0, 20e-3, [](double x) { return kPocket.pressure(x); }, 2000000);
  EXPECT_NEAR(load / kPocket.load(), 1, 1e-6);
}

TEST(BarusPressure, SolvesTheReducedEquation) {
  // q' = exp(-alpha p) p'.
  const double alpha = 2e-8;
  for (const double q : {1e6, 2e7, 4.9e7}) {
    const double slope = (barus_pressure(q + 10, alpha) - barus_pressure(q - 10, alpha)) / 20;
    EXPECT_NEAR(slope * std::exp(-alpha * barus_pressure(q, alpha)), 1, 1e-6);
  }
  EXPECT_EQ(barus_pressure(1e7, 0), 1e7);
  EXPECT_EQ(barus_pressure(5e7, alpha), std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace tabor::reference
