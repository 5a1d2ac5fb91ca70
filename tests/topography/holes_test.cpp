#include "tabor/topography/holes.hpp"

#include <gmock/gmock.h>

#include "support/sample_surfaces.hpp"
#include "support/worst.hpp"
#include "tabor/core/error.hpp"
#include "tabor/topography/geometry.hpp"
#include "tabor/topography/treatment.hpp"

namespace tabor::topography::test {

using namespace tabor::test;
namespace {

const Grid kGrid{90, 70, 90e-6, 35e-6};  // pixels 1 um x 0.5 um

/// x^2 - y^2 solves Laplace's equation, and the five-point formula is exact for it.
Topography saddle() {
  return surface(kGrid, [](double x, double y) { return (x * x - y * y) / 1e-4; });
}

Field filled(const Topography& topography, Fill fill) {
  return fill_holes(topography.height, topography.grid, fill).height;
}

TEST(FillHarmonic, ReproducesAHarmonicFunction) {
  const auto whole = saddle();
  auto holed = whole;
  holed.height.block(10, 20, 45, 50) = kHole;
  const auto result = fill_holes(holed.height, kGrid, Fill::harmonic);
  const double range = whole.height.maxCoeff() - whole.height.minCoeff();
  EXPECT_TRUE(result.convergence.converged());
  EXPECT_LT(largest_difference(result.height, whole.height), 1e-9 * range);
}

TEST(FillHarmonic, LeavesValidHeightsAsTheyAre) {
  auto holed = noise(kGrid);
  punch_holes(holed, 0.27);
  const Field result = filled(holed, Fill::harmonic);
  EXPECT_FALSE(result.hasNaN());
  EXPECT_TRUE(holed.height.isNaN().select(true, result == holed.height).all());
}

TEST(FillHarmonic, SolvesTheFivePointEquationInEveryMissingPixel) {
  auto holed = noise(kGrid);
  punch_holes(holed, 0.6);
  const Field z = filled(holed, Fill::harmonic);
  double largest = 0;
  for (Index y = 1; y + 1 < kGrid.ny; ++y) {
    for (Index x = 1; x + 1 < kGrid.nx; ++x) {
      if (std::isnan(holed.height(y, x))) {
        const double bend_x = (z(y, x - 1) - 2 * z(y, x) + z(y, x + 1)) / 1.0;
        const double bend_y = (z(y - 1, x) - 2 * z(y, x) + z(y + 1, x)) / 0.25;
        largest = tabor::test::worse(largest, std::abs(bend_x + bend_y));
      }
    }
  }
  EXPECT_LT(largest, 1e-10 * 1e-6);
}

TEST(FillHarmonic, HasNoSlopeAcrossTheEdgeOfTheScan) {
  const auto whole = surface(kGrid, [](double, double y) { return 3e-6 + 0.1 * y; });
  auto holed = whole;
  holed.height.block(20, 0, 30, 25) = kHole;
  EXPECT_LT(largest_difference(filled(holed, Fill::harmonic), whole.height), 1e-15);
}

TEST(FillHarmonic, MakesNoNewExtrema) {
  auto holed = noise(kGrid);
  holed.height.block(5, 5, 50, 60) = kHole;
  punch_holes(holed, 0.1);
  const Field result = filled(holed, Fill::harmonic);
  EXPECT_LE(result.maxCoeff(), holed.height.maxCoeff<Eigen::PropagateNumbers>());
  EXPECT_GE(result.minCoeff(), holed.height.minCoeff<Eigen::PropagateNumbers>());
}

TEST(FillHarmonic, CountsConnectedHoles) {
  auto holed = noise(kGrid);
  holed.height(0, 0) = kHole;
  holed.height(1, 1) = kHole;  // diagonal: another hole
  holed.height.block(20, 20, 4, 6) = kHole;
  const auto result = fill_holes(holed.height, kGrid, Fill::harmonic);
  EXPECT_EQ(result.n_filled, 26);
  EXPECT_EQ(result.n_holes, 3);
  EXPECT_EQ(result.largest, 24);
}

TEST(FillHarmonic, ContinuesFromASingleValidPixel) {
  auto holed = noise({33, 17, 1e-3, 1e-3});
  holed.height = kHole;
  holed.height(5, 7) = 4e-6;
  EXPECT_LT((filled(holed, Fill::harmonic) - 4e-6).abs().maxCoeff(), 1e-18);
}

TEST(FillHarmonic, GivesTheSameBitsOnAnyNumberOfThreads) {
  auto holed = noise({400, 300, 4e-4, 3e-4});
  punch_holes(holed, 0.3);
  holed.height.block(50, 60, 150, 200) = kHole;
  expect_same_bits_on_any_threads([&] { return filled(holed, Fill::harmonic); });
}

TEST(FillHarmonic, ConvergesInAFewIterationsWhateverTheSizeOfTheHole) {
  for (const Index n : {32, 128, 512}) {
    const auto side = static_cast<double>(n) * 1e-6;
    auto holed = noise({n, n, side, side});
    holed.height.block(4, 4, n - 8, n - 8) = kHole;
    const auto result = fill_holes(holed.height, holed.grid, Fill::harmonic);
    EXPECT_TRUE(result.convergence.converged());
    EXPECT_LE(result.convergence.iterations, 60) << n;
  }
}

TEST(Fill, CommutesWithUnitsAndTransposition) {
  auto holed = noise(kGrid);
  punch_holes(holed, 0.4);
  for (const Fill fill : {Fill::harmonic, Fill::mean}) {
    const Field expected = filled(holed, fill);
    auto scaled = holed;
    scaled.height *= 1e6;
    EXPECT_LT(largest_difference(filled(scaled, fill), 1e6 * expected), 1e-9);
    EXPECT_LT(largest_difference(filled(transpose(holed), fill), expected.transpose()), 1e-15);
  }
}

TEST(FillNearest, TakesAPixelThatIsNearest) {
  auto holed = noise(kGrid);
  punch_holes(holed, 0.95);
  const Field result = filled(holed, Fill::nearest);
  const auto distance = [&](Index y0, Index x0, Index y1, Index x1) {
    return std::hypot(static_cast<double>(x1 - x0) * kGrid.dx(),
                      static_cast<double>(y1 - y0) * kGrid.dy());
  };
  for (Index y = 0; y < kGrid.ny; y += 3) {
    for (Index x = 0; x < kGrid.nx; x += 3) {
      double nearest = 1, taken = 1;
      for (Index v = 0; v < kGrid.ny; ++v) {
        for (Index u = 0; u < kGrid.nx; ++u) {
          if (!std::isnan(holed.height(v, u))) {
            nearest = std::min(nearest, distance(y, x, v, u));
            if (holed.height(v, u) == result(y, x)) taken = distance(y, x, v, u);
          }
        }
      }
      ASSERT_NEAR(taken, nearest, 1e-15) << x << ' ' << y;
    }
  }
}

TEST(FillMean, TakesTheMeanOfTheValidHeights) {
  auto holed = surface({4, 2, 1, 1}, [](double x, double) { return x < 0.5 ? 1.0 : 3.0; });
  holed.height(0, 0) = kHole;
  EXPECT_DOUBLE_EQ(filled(holed, Fill::mean)(0, 0), 15.0 / 7);
}

TEST(Fill, LeavesASurfaceWithoutHolesAlone) {
  const auto whole = noise(kGrid);
  const auto result = fill_holes(whole, Fill::harmonic);
  EXPECT_TRUE(same_bits(result.height, whole.height));
  EXPECT_EQ(result.history.back(), "fill=harmonic: no holes");
}

TEST(Fill, SaysHowMuchWasFilled) {
  auto holed = noise({100, 100, 1e-4, 1e-4});
  holed.height.block(10, 10, 10, 11) = kHole;
  EXPECT_THAT(fill_holes(holed, Fill::harmonic).history.back(),
              testing::StartsWith("fill=harmonic: 110 pixels (1.1 %) in 1 holes, largest 110"));
}

TEST(Fill, InventedHeightsStayAWarningWhateverFollows) {
  for (const Fill fill : {Fill::harmonic, Fill::nearest, Fill::mean}) {
    for (const double share : {0.3, 0.8}) {
      auto holed = noise(kGrid);
      punch_holes(holed, share);
      const auto treated =
          apply({"fill=" + std::string(name_of(fill)), "level=plane", "mirror"}, holed);
      const auto warnings = texts_of(treated.warnings);
      EXPECT_THAT(warnings, testing::Contains(testing::HasSubstr("were holes")));
      EXPECT_THAT(warnings, testing::Contains(testing::HasSubstr("Most of the area is invented"))
                                .Times(share > 0.5 ? 1 : 0));
    }
  }
  auto nearly_whole = noise(kGrid);
  nearly_whole.height(3, 3) = kHole;
  EXPECT_TRUE(fill_holes(nearly_whole, Fill::harmonic).warnings.empty());
}

TEST(Fill, RejectsASurfaceOfHolesOnly) {
  auto holed = noise(kGrid);
  holed.height = kHole;
  for (const Fill fill : {Fill::harmonic, Fill::nearest, Fill::mean}) {
    EXPECT_THROW(fill_holes(holed, fill), InputError);
  }
}

}  // namespace
}  // namespace tabor::topography::test
