#include "tabor/topography/geometry.hpp"

#include <gmock/gmock.h>

#include "support/sample_surfaces.hpp"
#include "tabor/core/error.hpp"
#include "tabor/metrology/areal/parameters.hpp"
#include "tabor/topography/treatment.hpp"

namespace tabor::topography::test {

using namespace tabor::test;
namespace {

const Grid kGrid{12, 8, 24e-6, 8e-6};  // pixels 2 um x 1 um

TEST(Crop, KeepsTheWindowAndThePixels) {
  const auto rough = noise(kGrid);
  const auto part = crop(rough, {3, 2, 5, 4});
  EXPECT_EQ(part.grid.nx, 5);
  EXPECT_EQ(part.grid.ny, 4);
  EXPECT_DOUBLE_EQ(part.grid.dx(), 2e-6);
  EXPECT_DOUBLE_EQ(part.grid.dy(), 1e-6);
  EXPECT_TRUE(same_bits(part.height, rough.height.block(2, 3, 4, 5)));
}

TEST(Crop, EndsPeriodicityUnlessItKeepsEverything) {
  auto rough = noise(kGrid);
  rough.periodic = true;
  EXPECT_TRUE(crop(rough, {0, 0, 12, 8}).periodic);
  EXPECT_FALSE(crop(rough, {0, 0, 11, 8}).periodic);
}

TEST(Crop, RejectsWindowsOutsideTheScan) {
  const auto rough = noise(kGrid);
  const Index huge = std::numeric_limits<Index>::max();
  for (const PixelWindow& window : {PixelWindow{0, 0, 13, 8},
                                    {0, 0, 12, 9},
                                    {-1, 0, 3, 3},
                                    {0, 0, 0, 3},
                                    {12, 0, 1, 1},
                                    {1, 1, huge, 1},
                                    {huge, 0, huge, 1}}) {
    EXPECT_THROW(crop(rough, window), InputError);
  }
}

TEST(Trim, CutsAMarginOffAllSides) {
  const auto rough = noise({20, 14, 20e-6, 28e-6});
  const auto cut = trim_margins(rough, 4, 2);
  EXPECT_EQ(cut.grid.nx, 12);
  EXPECT_EQ(cut.grid.ny, 10);
  EXPECT_DOUBLE_EQ(cut.grid.lx, 12e-6);
  EXPECT_DOUBLE_EQ(cut.grid.ly, 20e-6);
  EXPECT_TRUE(same_bits(cut.height, rough.height.block(2, 4, 10, 12)));
  EXPECT_TRUE(same_bits(apply({"trim=4um"}, rough).height, cut.height));  // rows are 2 um high
}

TEST(Trim, RejectsToLeaveNothing) {
  const auto rough = noise({20, 14, 20e-6, 28e-6});
  EXPECT_THROW(trim_margins(rough, 10, 0), InputError);
  EXPECT_THROW(trim_margins(rough, 0, 7), InputError);
  EXPECT_THROW(trim_margins(rough, -1, 0), InputError);
  EXPECT_THROW(apply({"trim=1m"}, rough), InputError);
}

TEST(Mirror, IsContinuousAcrossItsSeams) {
  const auto rough = noise(kGrid);
  const auto tiled = mirror(rough);
  EXPECT_TRUE(tiled.periodic);
  EXPECT_EQ(tiled.grid.nx, 24);
  EXPECT_DOUBLE_EQ(tiled.grid.lx, 48e-6);
  EXPECT_TRUE(same_bits(tiled.height.topLeftCorner(8, 12), rough.height));
  EXPECT_TRUE((tiled.height.col(11) == tiled.height.col(12)).all());
  EXPECT_TRUE((tiled.height.col(0) == tiled.height.col(23)).all());
  EXPECT_TRUE((tiled.height.row(7) == tiled.height.row(8)).all());
  EXPECT_TRUE((tiled.height.row(0) == tiled.height.row(15)).all());
  EXPECT_NEAR(metrology::rms_height(tiled), metrology::rms_height(rough), 1e-20);
}

TEST(Flip, ReversesTheOrderOfColumnsOrRows) {
  const auto rough = noise(kGrid);
  EXPECT_EQ(flip(rough, Axis::x).height(2, 0), rough.height(2, 11));
  EXPECT_EQ(flip(rough, Axis::y).height(0, 3), rough.height(7, 3));
  EXPECT_TRUE(same_bits(flip(flip(rough, Axis::x), Axis::x).height, rough.height));
  EXPECT_TRUE(same_bits(flip(flip(rough, Axis::y), Axis::y).height, rough.height));
}

TEST(ResampleDown, AveragesWholeBlocks) {
  const auto rough = noise(kGrid);
  const auto coarse = resample(rough, 4, 4);
  EXPECT_NEAR(coarse.height(1, 2), rough.height.block(2, 6, 2, 3).mean(), 1e-20);
  EXPECT_DOUBLE_EQ(coarse.grid.lx, kGrid.lx);
}

TEST(ResampleDown, KeepsTheMeanAtAnyRatio) {
  const auto rough = noise(kGrid);
  for (const Index n : {1, 3, 5, 7, 8}) {
    EXPECT_NEAR(resample(rough, n, n).height.mean(), rough.height.mean(), 1e-19) << n;
  }
}

TEST(ResampleDown, AveragesTheValidPartAndLeavesMostlyMissingCellsAsHoles) {
  auto holed = surface({4, 4, 4, 4}, [](double x, double y) { return x + 10 * y; });
  holed.height(0, 0) = kHole;              // cell (0, 0): three of four valid
  holed.height.block(2, 2, 2, 2) = kHole;  // cell (1, 1): one of four valid
  holed.height(3, 3) = 1;
  const Field coarse = resample(holed, 2, 2).height;
  EXPECT_DOUBLE_EQ(coarse(0, 0), (6.5 + 15.5 + 16.5) / 3);
  EXPECT_TRUE(std::isnan(coarse(1, 1)));
  EXPECT_EQ(coarse.isNaN().count(), 1);
}

TEST(ResampleUp, KeepsAPlane) {
  const Grid fine{31, 29, kGrid.lx, kGrid.ly};
  const auto plane = [](double x, double y) { return 0.1 * x - 0.2 * y + 1e-6; };
  EXPECT_LT(largest_difference(resample(surface(kGrid, plane), 31, 29).height,
                               surface(fine, plane).height),
            1e-19);
}

TEST(ResampleUp, ConvergesWithTheFourthPowerOfThePixelOnAPeriodicWave) {
  const auto error = [](Index n) {
    const auto wave = [](double x, double y) {
      return std::cos(2 * pi * x) * std::sin(2 * pi * y);
    };
    auto coarse = surface({n, n, 1, 1}, wave);
    coarse.periodic = true;
    return largest_difference(resample(coarse, 3 * n, 3 * n).height,
                              surface({3 * n, 3 * n, 1, 1}, wave).height);
  };
  EXPECT_NEAR(std::log2(error(32) / error(64)), 4, 0.2);
}

TEST(Resample, LeavesASurfaceOfThatSizeAlone) {
  const auto rough = noise(kGrid);
  EXPECT_TRUE(same_bits(resample(rough, 12, 8).height, rough.height));
}

TEST(Resample, CommutesWithTransposition) {
  const auto rough = noise(kGrid);
  EXPECT_LT(largest_difference(resample(transpose(rough), 20, 5).height,
                               resample(rough, 5, 20).height.transpose()),
            1e-19);
}

TEST(Resample, RejectsImpossibleSizesAndSplinesOverHoles) {
  auto rough = noise(kGrid);
  EXPECT_THROW(resample(rough, 0, 4), InputError);
  EXPECT_THROW(resample(rough, 4, -1), InputError);
  EXPECT_THROW(resample(rough, 1000000, 4), InputError);
  rough.height(0, 0) = kHole;
  EXPECT_THROW(resample(rough, 24, 8), InputError);
}

}  // namespace
}  // namespace tabor::topography::test
