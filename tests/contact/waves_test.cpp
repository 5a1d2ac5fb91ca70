#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "contact/surfaces.hpp"
#include "support/validation.hpp"
#include "support/worst.hpp"
#include "tabor/reference/waves.hpp"

namespace tabor::test {
namespace {

constexpr double kAmplitude = 0.01;

double jgh_area(Index n, double load_ratio) {
  const double full = reference::jgh_full_contact_pressure(1.0, kAmplitude, 1.0);
  const Solved solved =
      solve_unit(wave(n, kAmplitude, true), load_ratio * full, contact::kNoSaturation, 1e-8);
  EXPECT_TRUE(solved.state.convergence.converged());
  return solved.summary.contact_area_fraction;
}

TEST(SolveContact, FindsTheTwoDimensionalWaveBetweenItsLimits) {
  double worst = 0;
  for (const auto& point : reference::kJghTable) {
    worst = test::worse(worst, std::abs(jgh_area(512, point.load_ratio) - point.area_fraction));
  }
  expect_within("Contact", "Johnson-Greenwood-Higginson wave, n = 512", "area at 7 loads, absolute",
                "contact.md section 5", worst, 3e-3);
}

TEST(SolveContact, FindsTheTwoDimensionalWaveAtItsLimits) {
  const double low = 2e-4;
  const double high = 0.99;
  expect_within("Contact", "Johnson-Greenwood-Higginson wave, P/p* = 2e-4", "area, relative",
                "Hertz limit",
                std::abs(jgh_area(1024, low) / reference::jgh_area_at_low_load(low) - 1), 1e-2);
  expect_within("Contact", "Johnson-Greenwood-Higginson wave, P/p* = 0.99", "area, relative",
                "full-contact limit",
                std::abs(jgh_area(1024, high) / reference::jgh_area_at_high_load(high) - 1), 1e-2);
}

class LargeSmooth : public testing::TestWithParam<double> {};

TEST_P(LargeSmooth, ContactsConverge) {
  const reference::WestergaardWave wave_reference{kAmplitude, 1.0, 1.0};
  const Solved solved = solve_unit(wave(1024, kAmplitude, false),
                                   GetParam() * wave_reference.full_contact_pressure());
  EXPECT_TRUE(solved.state.convergence.converged()) << solved.state.convergence.certificate;
  // Contact and grid are symmetric: the width changes by two pixels at once.
  EXPECT_NEAR(solved.summary.contact_area_fraction_pixels,
              wave_reference.area_fraction(GetParam() * wave_reference.full_contact_pressure()),
              2.0 / 1024);
}

INSTANTIATE_TEST_SUITE_P(Westergaard, LargeSmooth, testing::Values(0.1, 0.5, 0.8, 0.99));

}  // namespace
}  // namespace tabor::test
