// Where oil goes when surfaces close on it.
#include "tabor/reynolds/patch/patch_oil.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "patches.hpp"

namespace tabor::reynolds {
namespace {

using test::rough_patch;
using test::row_patch;

PatchOil settled(const PatchProblem& problem, const Field& oil) {
  const PatchCells cells = patch_cells(problem);
  return settle(cells, components_of(cells), oil, 0);
}

Field row(std::initializer_list<double> values) {
  Field field(1, static_cast<Index>(values.size()));
  std::copy(values.begin(), values.end(), field.data());
  return field;
}

TEST(Components, AreCutByWallsAndWrapAround) {
  const Components components =
      components_of(patch_cells(row_patch(row({1e-6, 0, 1e-6, 2e-6, 0, 1e-6}))));
  EXPECT_EQ(components.count(), 2);
  EXPECT_EQ(components.of[0], components.of[5]);
  EXPECT_EQ(components.of[2], components.of[3]);
  EXPECT_NE(components.of[0], components.of[2]);
  EXPECT_EQ(components.of[1], -1);
  EXPECT_EQ(components.widest[static_cast<std::size_t>(components.of[2])], 3);
}

TEST(Settle, LeavesOilThatFitsWhereItIs) {
  const Field oil = row({0, 0, 1e-6, 5e-7});
  const PatchOil result = settled(row_patch(row({1e-6, 0, 1e-6, 1e-6})), oil);
  EXPECT_TRUE((result.volume == oil).all());
  EXPECT_EQ(result.outside, 0);
}

TEST(Settle, MovesOilFromWallsToTheNearestOpenCell) {
  const PatchOil result =
      settled(row_patch(row({3e-6, 0, 0, 0, 3e-6, 3e-6})), row({0, 1e-6, 0, 2e-6, 0, 0}));
  EXPECT_TRUE(result.volume.isApprox(row({1e-6, 0, 0, 0, 2e-6, 0}), 1e-14));
}

TEST(Settle, SpreadsWhatARoomCannotHoldOverTheOthers) {
  const PatchOil result =
      settled(row_patch(row({1e-6, 0, 4e-6, 2e-6, 0})), row({4e-6, 0, 0, 1e-6, 0}));
  // 3 um too much for the first component; the other lacks 4 um and 1 um.
  EXPECT_TRUE(result.volume.isApprox(row({1e-6, 0, 2.4e-6, 1.6e-6, 0}), 1e-13));
  EXPECT_EQ(result.outside, 0);
}

TEST(Settle, CountsAsOutsideWhatThePatchCannotHold) {
  const PatchProblem problem = row_patch(row({1e-6, 0, 2e-6}));
  const PatchOil result = settled(problem, row({3e-6, 1e-6, 1e-6}));
  EXPECT_TRUE((result.volume == problem.gap).all());
  EXPECT_NEAR(result.outside, 2e-6, 1e-20);
  const PatchOil closed = settled(row_patch(row({0, 0, 0})), row({1e-6, 0, 0}));
  EXPECT_NEAR(closed.outside, 1e-6, 1e-20);
}

TEST(Settle, KeepsTheVolumeOfOilToRoundOff) {
  const PatchProblem problem = rough_patch(48, 0.6e-6);
  for (const double mean : {0.1e-6, 0.5e-6, 2e-6}) {
    const Field oil = mean * (1 + Field::Random(48, 48));
    const PatchOil result = settled(problem, oil);
    EXPECT_NEAR((result.volume.sum() + result.outside) / oil.sum(), 1, 1e-13) << mean;
    EXPECT_GE(result.volume.minCoeff(), 0);
  }
}

}  // namespace
}  // namespace tabor::reynolds
