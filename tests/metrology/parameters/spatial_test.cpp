// Spatial parameters: lengths and directions of waves.
#include <gmock/gmock.h>

#include <cmath>

#include "support/sample_surfaces.hpp"
#include "tabor/core/error.hpp"
#include "values.hpp"

namespace tabor::metrology::test {

using namespace tabor::test;
namespace {

constexpr auto kSpatial = ParameterSet::spatial;

/// cos(2 pi (i x / lx + j y / ly)), whole waves, y downwards.
topography::Topography wave(const Grid& grid, int i, int j) {
  return surface(grid, [=](double x, double y) {
    return 1e-6 * std::cos(2 * pi * (i * x / grid.lx + j * y / grid.ly));
  });
}

TEST(Spatial, OfGroovesAlongYAreTheirDecayAndNoAspect) {
  const auto grooves = wave({1600, 400, 1.6e-3, 4e-4}, 40, 0);
  // cos(2 pi r / 40 um) = 0.2; the ends of the scan leave an error of some 1/(4 pi 40)
  EXPECT_NEAR(value(grooves, kSpatial, "Sal") / (40e-6 * std::acos(0.2) / (2 * pi)), 1, 5e-3);
  const Parameter str = parameter(grooves, kSpatial, "Str");
  EXPECT_TRUE(std::isnan(str.value));
  EXPECT_THAT(str.note, testing::StartsWith("< 0.02"));
  EXPECT_EQ(value(grooves, kSpatial, "Std"), 0);
  EXPECT_NEAR(value(grooves, kSpatial, "Ssw"), 40e-6, 1e-15);
}

TEST(Spatial, OfGroovesAlongXPointUp) {
  const auto grooves = wave({300, 400, 3e-4, 4e-4}, 0, 10);
  EXPECT_EQ(value(grooves, kSpatial, "Std"), 90);
  EXPECT_NEAR(value(grooves, kSpatial, "Ssw"), 40e-6, 1e-15);
}

struct Mode {
  Grid grid;
  int i, j;
};

class ObliqueWave : public testing::TestWithParam<Mode> {};

TEST_P(ObliqueWave, HasTheDirectionOfItsWavevector) {
  const auto [grid, i, j] = GetParam();
  const auto oblique = wave(grid, i, j);
  // y counts downwards, the angle upwards
  double angle = std::atan2(-j / grid.ly, i / grid.lx) * 180 / pi;
  if (angle < 0) angle += 180;
  EXPECT_NEAR(value(oblique, kSpatial, "Std"), angle, 1.0);
  EXPECT_NEAR(value(oblique, kSpatial, "Ssw"), 1 / std::hypot(i / grid.lx, j / grid.ly), 1e-15);
}

INSTANTIATE_TEST_SUITE_P(Modes, ObliqueWave,
                         testing::Values(Mode{{200, 200, 2e-4, 2e-4}, 20, 20},
                                         Mode{{200, 200, 2e-4, 2e-4}, 20, -20},
                                         Mode{{300, 150, 3e-4, 1.5e-4}, 24, 7},
                                         Mode{{200, 160, 2e-4, 4e-4}, 30, -11}));

/// Grooves with the wavevector at `angle` [degrees], 10 pixels apart, as cut from a larger surface.
topography::Topography grooves_at(double angle, Index nx, Index ny) {
  const double c = std::cos(angle * pi / 180), s = std::sin(angle * pi / 180);
  return surface(
      {nx, ny, 1e-6 * static_cast<double>(nx), 1e-6 * static_cast<double>(ny)},
      [=](double x, double y) { return 1e-6 * std::cos(2 * pi * (c * x - s * y) / 10e-6 + 0.3); });
}

/// Right to a few degrees or, on a strip too narrow for that, no number and why; what the note says
/// it is known to holds.
TEST(Spatial, OfGroovesOnStripsAreRightOrNothing) {
  int n_found = 0;
  for (const auto& [nx, ny] : {std::pair<Index, Index>{200, 200},
                               {200, 100},
                               {200, 64},
                               {200, 32},
                               {200, 8},
                               {200, 4},
                               {200, 2},
                               {32, 200},
                               {4, 200}}) {
    for (int angle = 0; angle < 180; angle += 15) {
      const Parameter std = parameter(grooves_at(angle, nx, ny), kSpatial, "Std");
      if (std::isnan(std.value)) {
        EXPECT_THAT(std.note, testing::HasSubstr("too narrow")) << nx << ' ' << ny << ' ' << angle;
        EXPECT_LT(std::min(nx, ny), 100) << angle;
        continue;
      }
      ++n_found;
      const double off = std::abs(std.value - angle);
      EXPECT_LE(std::min(off, 180 - off), 10) << nx << ' ' << ny << ' ' << angle;
    }
  }
  EXPECT_GE(n_found, 50);
}

/// Whole waves along an axis leave nothing beside it, however few the rows.
TEST(Spatial, OfGroovesAcrossAStripAreKnown) {
  for (const Index ny : {2, 3, 8, 20}) {
    EXPECT_EQ(value(grooves_at(0, 200, ny), kSpatial, "Std"), 0) << ny;
    EXPECT_EQ(value(grooves_at(90, ny, 200), kSpatial, "Std"), 90) << ny;
  }
}

TEST(Spatial, DoNotMindAFewHoles) {
  auto oblique = wave({300, 200, 3e-4, 2e-4}, 24, 12);
  const double sal = value(oblique, kSpatial, "Sal"), std = value(oblique, kSpatial, "Std");
  punch_holes(oblique, 0.1);
  EXPECT_NEAR(value(oblique, kSpatial, "Sal") / sal, 1, 1e-2);
  EXPECT_EQ(value(oblique, kSpatial, "Std"), std);
  EXPECT_THAT(parameter(oblique, kSpatial, "Std").note, testing::HasSubstr("holes"));
}

TEST(Spatial, WarnAboutFieldsThatAreNotSquare) {
  EXPECT_THAT(parameter(wave({64, 32, 64, 32}, 4, 0), kSpatial, "Std").note,
              testing::HasSubstr("not square"));
  EXPECT_EQ(parameter(wave({64, 64, 64, 64}, 4, 0), kSpatial, "Std").note, "");
}

/// In steps of the shorter side of a pixel this would take hours.
TEST(Spatial, OfPixelsAMillionTimesLongerThanWideAreFound) {
  const auto across = wave({400, 64, 4e-4, 64.0}, 10, 0);
  EXPECT_NEAR(value(across, kSpatial, "Sal") / (40e-6 * std::acos(0.2) / (2 * pi)), 1, 2e-2);
  EXPECT_EQ(value(across, kSpatial, "Std"), 0);
}

TEST(Spatial, OfATiltNeverDecayAndSaySo) {
  const auto tilt = surface({50, 40, 50, 40}, [](double x, double) { return x; });
  const auto flat = surface({50, 40, 50, 40}, [](double, double) { return 0.1; });
  EXPECT_TRUE(std::isnan(value(flat, kSpatial, "Sal")));
  EXPECT_NE(parameter(flat, kSpatial, "Sal").note, "");
  EXPECT_NE(parameter(tilt, kSpatial, "Str").note, "");
}

TEST(Spatial, RejectAThresholdThatNothingCrosses) {
  const auto grooves = wave({40, 30, 4e-4, 3e-4}, 8, 0);
  for (const double threshold : {0.0, 1.0, -0.2, kHole}) {
    EXPECT_THROW(parameters(grooves, {.sets = {kSpatial}, .acf_threshold = threshold}), InputError);
  }
}

}  // namespace
}  // namespace tabor::metrology::test
