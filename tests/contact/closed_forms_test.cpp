#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "contact/surfaces.hpp"
#include "support/validation.hpp"
#include "support/worst.hpp"
#include "tabor/reference/waves.hpp"

namespace tabor::test {
namespace {

constexpr double kAmplitude = 0.01;

struct WestergaardErrors {
  double peak = 0;   // relative
  double l2 = 0;     // relative
  double width = 0;  // pixels
};

/// One row of n pixels is the whole plane-strain problem.
WestergaardErrors compare_with_westergaard(Index n, double ratio) {
  const reference::WestergaardWave reference_wave{kAmplitude, 1.0, 1.0};
  const double mean_pressure = ratio * reference_wave.full_contact_pressure();
  Field row(1, n);
  for (Index x = 0; x < n; ++x) {
    row(0, x) = kAmplitude * std::cos(2 * std::numbers::pi * (static_cast<double>(x) + 0.5) /
                                      static_cast<double>(n));
  }
  const Solved solved = solve_unit(row, mean_pressure, contact::kNoSaturation, 1e-9);
  EXPECT_TRUE(solved.state.convergence.converged());
  double squares = 0;
  double difference = 0;
  double peak = 0;
  for (Index x = 0; x < n; ++x) {
    const double position = (static_cast<double>(x) + 0.5) / static_cast<double>(n);
    const double expected =
        reference_wave.pressure(mean_pressure, position > 0.5 ? position - 1 : position);
    squares += expected * expected;
    difference += std::pow(solved.state.pressure(0, x) - expected, 2);
    peak = std::max(peak, expected);
  }
  const auto pixels = static_cast<double>(n);
  return {std::abs(solved.state.pressure.maxCoeff() / peak - 1), std::sqrt(difference / squares),
          std::abs(solved.summary.contact_area_fraction_pixels -
                   reference_wave.area_fraction(mean_pressure)) *
              pixels};
}

TEST(SolveContact, FindsWestergaardsPressure) {
  // The error of the pressure is of order (pixel / contact width)^(3/2): light loads, whose contact
  // is a few per cent of the wave, take finer grids to the same tolerance.
  struct Item {
    Index n;
    double ratio;  // P / p*
  };
  for (const Item item : {Item{256, 0.5}, {256, 0.8}, {2048, 0.05}, {2048, 0.2}}) {
    const WestergaardErrors errors = compare_with_westergaard(item.n, item.ratio);
    const std::string name = fmt::format("Westergaard wave, n = {}, P/p* = {}", item.n, item.ratio);
    expect_within("Contact", name, "peak pressure, relative", "Westergaard 1939", errors.peak,
                  1e-5);
    expect_within("Contact", name, "pressure, L2 relative", "Westergaard 1939", errors.l2, 2e-3);
    expect_within("Contact", name, "contact width, pixels", "Westergaard 1939", errors.width, 0.75);
  }
}

TEST(SolveContact, ConvergesToWestergaardWithTheGrid) {
  const double coarse = compare_with_westergaard(128, 0.3).l2;
  const double fine = compare_with_westergaard(2048, 0.3).l2;
  // The pressure ends like a square root, so that the last pixel of each edge is wrong by about
  // sqrt(h) on a width h: order 1 in the L2 norm, up to where the edge falls between two pixels.
  const double order = std::log2(coarse / fine) / 4;
  expect_within("Contact", "Westergaard wave, n = 128 to 2048", "distance of the L2 order from 1",
                "square-root edge of the pressure", std::abs(order - 1), 0.25);
}

TEST(SolveContact, IsExactAtFullContact) {
  const Index n = 64;
  const reference::WestergaardWave wave_reference{kAmplitude, 1.0, 1.0};
  const double full = wave_reference.full_contact_pressure();
  double worst = 0;
  for (const double ratio : {1.0 + 1e-9, 1.5, 20.0}) {
    const Solved solved =
        solve_unit(wave(n, kAmplitude, false), ratio * full, contact::kNoSaturation, 1e-9);
    const Field expected = ratio * full + wave(n, full, false);
    worst = test::worse(worst, (solved.state.pressure - expected).abs().maxCoeff() / full);
    EXPECT_EQ(solved.summary.contact_area_fraction_pixels, 1.0);
    EXPECT_EQ(solved.state.convergence.operator_applications, 1);  // for the certificate
  }
  expect_within("Contact", "full contact of a wave, onset included", "pressure, relative to p*",
                "p = P + S^-1 z", worst, 1e-10);
}

TEST(SolveContact, CarriesAConstantSurfaceUniformly) {
  for (const auto& [ny, nx] : {std::pair<Index, Index>{16, 16}, {1, 9}, {5, 1}, {1, 1}}) {
    const Solved solved = solve_unit(Field::Constant(ny, nx, 3.0), 0.25);
    EXPECT_TRUE(solved.state.convergence.converged());
    EXPECT_LE((solved.state.pressure - 0.25).abs().maxCoeff(), 1e-15);
    EXPECT_NEAR(solved.state.separation, 3.0, 1e-12);
  }
}

/// Half a pixel at either edge of each contact is all that counting may miss.
TEST(SolveContact, CountsTheAreaOfWavesAlongEitherAxis) {
  const reference::WestergaardWave wave_reference{kAmplitude, 1.0, 1.0};
  const Index n = 128;
  for (const double ratio : {0.02, 0.1, 0.5, 0.8}) {
    const double mean_pressure = ratio * wave_reference.full_contact_pressure();
    const Field along_x = wave(n, kAmplitude, false);
    for (const Field& height : {along_x, Field(along_x.transpose()), Field(along_x.row(0))}) {
      for (const double cap : {contact::kNoSaturation, 1e3 * mean_pressure}) {
        const contact::Summary found = solve_unit(height, mean_pressure, cap).summary;
        EXPECT_FALSE(found.area_correction_valid);
        EXPECT_NEAR(found.contact_area_fraction, wave_reference.area_fraction(mean_pressure),
                    2.0 / static_cast<double>(n));
      }
    }
  }
}

/// Flat tops touch as wholes under a small load: their area is what was drawn.
TEST(SolveContact, FindsTheAreaOfRidgesAndPunchesExactly) {
  const Index n = 64;
  const auto is_top = [](Index i) { return i % 32 < 8; };
  Field ridges(n, n), punches(n, n);
  for (Index y = 0; y < n; ++y) {
    for (Index x = 0; x < n; ++x) {
      ridges(y, x) = is_top(x) ? 0 : -1;
      punches(y, x) = is_top(x) && is_top(y) ? 0 : -1;
    }
  }
  for (const double cap : {contact::kNoSaturation, 1.0}) {
    for (const Field& height : {ridges, Field(ridges.transpose())}) {
      EXPECT_DOUBLE_EQ(solve_unit(height, 1e-5, cap).summary.contact_area_fraction, 0.25);
    }
    EXPECT_DOUBLE_EQ(solve_unit(punches, 1e-5, cap).summary.contact_area_fraction, 0.0625);
  }
}

}  // namespace
}  // namespace tabor::test
