#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "contact/surfaces.hpp"
#include "support/validation.hpp"
#include "tabor/reference/hertz.hpp"
#include "tabor/reference/punches.hpp"

namespace tabor::test {
namespace {

/// Heights of a body of revolution whose tip is on a pixel of a unit square of n pixels (n odd).
template <typename Profile>
Field revolved(Index n, const Profile& profile) {
  Field height(n, n);
  const double h = 1.0 / static_cast<double>(n);
  for (Index y = 0; y < n; ++y) {
    for (Index x = 0; x < n; ++x) {
      height(y, x) =
          profile(h * std::hypot(static_cast<double>(x - n / 2), static_cast<double>(y - n / 2)));
    }
  }
  return height;
}

/// Mean pressure of a Hertz contact of radius a on the unit square, E* = 1, R = 1.
double hertz_load(double radius) { return 4.0 / 3 * std::pow(radius, 3); }

TEST(SolveContact, FindsHertzOnAFreePatch) {
  const Index n = 161;
  const double radius = 40.0 / static_cast<double>(n);
  const auto hertz = reference::hertz_at_load(1.0, 1.0, hertz_load(radius));
  const Field height = revolved(n, [](double r) { return -0.5 * r * r; });
  const Solved solved =
      solve_unit(height, hertz.load, contact::kNoSaturation, 1e-9, contact::Solver::fast, false);
  ASSERT_TRUE(solved.state.convergence.converged());
  const double area = std::numbers::pi * radius * radius;
  expect_within("Contact", "Hertz, free, a/h = 40", "approach, relative", "Hertz 1882",
                std::abs(-solved.summary.separation / hertz.approach - 1), 2e-4);
  expect_within("Contact", "Hertz, free, a/h = 40", "peak pressure, relative", "Hertz 1882",
                std::abs(solved.summary.max_pressure / hertz.max_pressure - 1), 5e-4);
  expect_within("Contact", "Hertz, free, a/h = 40", "corrected area, relative", "Hertz 1882",
                std::abs(solved.summary.contact_area_fraction / area - 1), 1e-2);
}

TEST(SolveContact, SeesTheImagesOfAPeriodicHertzContact) {
  const Index n = 513;
  const double radius = 0.1;
  const auto hertz = reference::hertz_at_load(1.0, 1.0, hertz_load(radius));
  const Field height = revolved(n, [](double r) { return -0.5 * r * r; });
  const Solved solved = solve_unit(height, hertz.load, contact::kNoSaturation, 1e-8);
  ASSERT_TRUE(solved.state.convergence.converged());
  const double area = std::numbers::pi * radius * radius;
  expect_within("Contact", "Hertz, periodic, a/L = 0.1", "peak pressure against +0.12 %",
                "contact.md section 5",
                std::abs(solved.summary.max_pressure / hertz.max_pressure - 1 - 0.0012), 1e-3);
  expect_within("Contact", "Hertz, periodic, a/L = 0.1", "corrected area against -0.34 %",
                "contact.md section 5",
                std::abs(solved.summary.contact_area_fraction / area - 1 + 0.0034), 1e-3);
}

TEST(SolveContact, FindsTheStiffnessOfAFlatPunch) {
  const Index n = 221;
  const double radius = 100.0 / static_cast<double>(n);
  const double indentation = 1e-3;
  const reference::FlatPunch punch{radius, 1.0};
  const Field height = revolved(n, [&](double r) { return r <= radius ? 0.0 : -1.0; });
  const Solved solved = solve_unit(height, punch.load(indentation), contact::kNoSaturation, 1e-9,
                                   contact::Solver::fast, false);
  ASSERT_TRUE(solved.state.convergence.converged());
  expect_within("Contact", "flat punch, free, a/h = 100", "indentation, relative", "F = 2 a E* d",
                std::abs(-solved.summary.separation / indentation - 1), 5e-3);
}

TEST(SolveContact, FindsTheMeanPressureUnderACone) {
  const Index n = 221;
  const double radius = 100.0 / static_cast<double>(n);
  const reference::Cone cone{0.01, 1.0};
  const double load = cone.mean_pressure() * std::numbers::pi * radius * radius;
  const Field height = revolved(n, [&](double r) { return -r * std::tan(cone.slope_angle); });
  const Solved solved =
      solve_unit(height, load, contact::kNoSaturation, 1e-9, contact::Solver::fast, false);
  ASSERT_TRUE(solved.state.convergence.converged());
  const double mean_pressure = load / solved.summary.contact_area_fraction;
  expect_within("Contact", "cone, free, a/h = 100", "mean pressure, relative", "E* tan(b) / 2",
                std::abs(mean_pressure / cone.mean_pressure() - 1), 5e-3);
}

}  // namespace
}  // namespace tabor::test
