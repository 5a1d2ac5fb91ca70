#include "tabor/forming/friction_table.hpp"

#include <gmock/gmock.h>

#include "forming/made_table.hpp"
#include "tabor/core/error.hpp"

namespace tabor::forming {
namespace {

using test::made_table;
using test::some_law;

TEST(LayersOf, HoldEveryNumberOnce) {
  const FrictionTable table = made_table({2e6, 5e6, 7e6}, {0, 9e-4}, {0.01, 0.1}, some_law);
  std::vector<double> friction;
  for (const DensityLayer& layer : layers_of(table)) {
    EXPECT_EQ(layer.rows.size(), 3u);
    for (const PressureRow& row : layer.rows) {
      EXPECT_EQ(row.entries.size(), 2u);
      for (const FrictionEntry& entry : row.entries) {
        EXPECT_EQ(entry.at.mean_pressure, row.mean_pressure);
        EXPECT_EQ(entry.at.lubricant_density, layer.lubricant_density);
        friction.push_back(entry.friction);
      }
    }
  }
  ASSERT_EQ(friction.size(), table.entries.size());
  for (std::size_t i = 0; i < friction.size(); ++i) {
    EXPECT_EQ(friction[i], table.entries[i].friction);
  }
}

TEST(CompleteRows, LeaveOutPressuresWithoutAllSpeeds) {
  FrictionTable table = made_table({2e6, 5e6, 7e6}, {9e-4}, {0.01, 0.1}, some_law);
  table.entries.erase(table.entries.begin() + 2);  // 5 MPa at 0.01 m/s
  const FrictionTable complete = complete_rows(table);
  ASSERT_EQ(complete.entries.size(), 4u);
  EXPECT_EQ(complete.entries[2].at.mean_pressure, 7e6);
  ASSERT_EQ(complete.left_out.size(), 1u);
  EXPECT_EQ(complete.left_out[0].code, "incomplete");
  EXPECT_EQ(complete.left_out[0].at, (Condition{5e6, 9e-4, 0.1}));
}

TEST(CompleteRows, LeaveACompleteTableAsItIs) {
  const FrictionTable table = made_table({2e6, 5e6}, {0, 9e-4}, {}, some_law);
  EXPECT_EQ(complete_rows(table).entries.size(), table.entries.size());
  EXPECT_TRUE(complete_rows(table).left_out.empty());
}

TEST(RequireTwoPressures, OfEachDensity) {
  FrictionTable table = made_table({2e6, 5e6}, {0, 9e-4}, {}, some_law);
  EXPECT_NO_THROW(require_two_pressures(table));
  table.entries.pop_back();
  EXPECT_THROW(require_two_pressures(table), InputError);
}

TEST(ReasonsOf, CountMissingNumbersAndThoseOverFewerScans) {
  FrictionTable table;
  table.left_out = {{.code = "flood", .scans = {"a", "b"}},
                    {.code = "failed", .scans = {"a", "b"}, .whole = false},
                    {.code = "flood", .scans = {"a"}}};
  EXPECT_EQ(reasons_of(table), "flood 2");
  EXPECT_EQ(reasons_for_fewer_scans(table), "failed 1");
  EXPECT_EQ(n_left_out(table), 2u);
}

}  // namespace
}  // namespace tabor::forming
