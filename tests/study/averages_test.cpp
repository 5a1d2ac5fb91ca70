#include "tabor/study/averages.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "tabor/study/tables.hpp"

namespace tabor::study {
namespace {

Row row(const std::string& group, double pressure, double friction) {
  Row made;
  made.group = group;
  made.mean_pressure = pressure;
  made.friction_dry = friction;
  made.friction_lubricated = friction / 2;
  made.converged = true;
  return made;
}

TEST(MeanOf, MatchesTheTextbookNumbers) {
  // 2, 4, 4, 4, 5, 5, 7, 9: mean 5, sum of squared deviations 32.
  const Mean mean = mean_of({2, 4, 4, 4, 5, 5, 7, 9});
  EXPECT_EQ(mean.n, 8u);
  EXPECT_DOUBLE_EQ(mean.mean, 5);
  EXPECT_DOUBLE_EQ(mean.standard_deviation, std::sqrt(32.0 / 7));
  EXPECT_DOUBLE_EQ(mean.standard_error, std::sqrt(32.0 / 7 / 8));
}

TEST(MeanOf, OneValueHasNoError) {
  const Mean same = mean_of({0.3038, 0.3038, std::nextafter(0.3038, 1)});  // but for rounding
  EXPECT_EQ(same.standard_deviation, 0);
  EXPECT_EQ(same.standard_error, 0);
  EXPECT_EQ(mean_of({3}).mean, 3);
  EXPECT_TRUE(std::isnan(mean_of({3}).standard_deviation));
  EXPECT_TRUE(std::isnan(mean_of({3}).standard_error));
  EXPECT_TRUE(std::isnan(mean_of({}).mean));
}

TEST(Averages, KeepGroupsInOrderOfAppearanceAndPressuresRising) {
  const std::vector<Row> rows{row("B", 5, 0.1), row("A", 5, 0.4), row("B", 2, 0.2),
                              row("B", 5, 0.3)};
  const std::vector<Average> result = averages(rows);
  ASSERT_EQ(result.size(), 3u);
  EXPECT_EQ(result[0].group, "B");
  EXPECT_EQ(result[0].mean_pressure, 2);
  EXPECT_EQ(result[1].mean_pressure, 5);
  EXPECT_EQ(result[1].n, 2u);
  EXPECT_DOUBLE_EQ(result[1].friction_dry.mean, 0.2);
  EXPECT_DOUBLE_EQ(result[1].friction_lubricated.mean, 0.1);
  EXPECT_EQ(result[2].group, "A");
}

/// One row whose film has such a warning is enough, as the mean over the rest is of drier scans.
TEST(Averages, SayWhyAFrictionTableLeavesThemOut) {
  std::vector<Row> rows{row("A", 5, 0.1), row("A", 5, 0.3), row("B", 5, 0.1), row("C", 5, 0.1),
                        row("D", 5, 0.1), row("D", 5, 0.1), row("E", 5, 0.1)};
  for (Row& one : rows) one.lubricant_density = 1e-3;
  rows[1].warnings = {{"resolution", "small patches"}, {"flood", "too much oil"}};
  rows[2].warnings = {{"resolution", "small patches"}};
  rows[3].converged = false;
  rows[4].converged = false;  // the other scan of D counts
  rows[6].error = "no surface";
  std::vector<std::string> reasons;
  for (const Average& one : averages(rows)) reasons.push_back(one.left_out);
  EXPECT_THAT(reasons, testing::ElementsAre("flood", "", "not-converged", "", "failed"));
  for (Row& one : rows) one.lubricant_density = 0;  // no warning about oil counts
  EXPECT_EQ(averages(rows).front().left_out, "");
}

TEST(Averages, CountOnlyRowsThatConverged) {
  std::vector<Row> rows{row("A", 5, 0.1), row("A", 5, 0.9), row("A", 5, 0.5)};
  rows[1].converged = false;
  rows[2].error = "no surface";
  const std::vector<Average> result = averages(rows);
  ASSERT_EQ(result.size(), 1u);
  EXPECT_EQ(result[0].n, 1u);
  EXPECT_DOUBLE_EQ(result[0].friction_dry.mean, 0.1);
}

TEST(AveragesCsv, LeavesCellsWithoutValueEmpty) {
  EXPECT_EQ(averages_csv(averages({row("A, left", 5e6, 0.25)})),
            "group,mean_pressure_Pa,lubricant_density_g_per_m2,n,friction_dry_mean,"
            "friction_dry_std,friction_dry_sem,friction_lubricated_mean,friction_lubricated_std,"
            "friction_lubricated_sem,left_out\n"
            "\"A, left\",5000000,0,1,0.25,,,0.125,,,\n");
}

Row sliding(double speed, double mixed) {
  Row made = row("A", 5e6, 0.25);
  made.fluid.emplace();
  made.fluid->sliding_speed = speed;
  made.fluid->load_share = 0.1;
  made.fluid->friction_viscous = 0.01;
  made.fluid->friction_mixed = mixed;
  return made;
}

TEST(Averages, KeepSpeedsApart) {
  const std::vector<Average> result =
      averages({sliding(1, 0.25), sliding(0, 0.5), sliding(1, 0.75)});
  ASSERT_EQ(result.size(), 2u);
  ASSERT_TRUE(result[0].fluid.has_value());
  EXPECT_EQ(result[0].fluid->sliding_speed, 0);
  EXPECT_DOUBLE_EQ(result[0].fluid->friction_mixed.mean, 0.5);
  EXPECT_EQ(result[1].fluid->sliding_speed, 1);
  EXPECT_EQ(result[1].n, 2u);
  EXPECT_DOUBLE_EQ(result[1].fluid->friction_mixed.mean, 0.5);
  EXPECT_DOUBLE_EQ(result[1].fluid->friction_mixed.standard_error, 0.25);
}

TEST(AveragesCsv, AddsColumnsWhereTheOilFlows) {
  const std::string dry = averages_csv(averages({sliding(0.5, 0.2)}));
  const std::string flowing =
      averages_csv(averages({sliding(0.5, 0.2)}), {.trapped = false, .fluid = true, .tool = false});
  EXPECT_EQ(dry.find("speed"), std::string::npos);
  EXPECT_EQ(flowing,
            "group,mean_pressure_Pa,lubricant_density_g_per_m2,n,friction_dry_mean,"
            "friction_dry_std,friction_dry_sem,friction_lubricated_mean,friction_lubricated_std,"
            "friction_lubricated_sem,sliding_speed_m_per_s,fluid_load_share_mean,"
            "fluid_load_share_std,fluid_load_share_sem,friction_viscous_mean,friction_viscous_std,"
            "friction_viscous_sem,friction_mixed_mean,friction_mixed_std,friction_mixed_sem,"
            "left_out\n"
            "A,5000000,0,1,0.25,,,0.125,,,0.5,0.1,,,0.01,,,0.2,,,\n");
}

TEST(AveragesCsv, HasTheLoadThatTrappedOilCarries) {
  std::vector<Row> rows{row("A", 5e6, 0.25), row("A", 5e6, 0.35)};
  for (Row& one : rows) one.trapped.emplace();
  rows[0].trapped->load_share = 0.125;
  rows[1].trapped->load_share = 0.375;
  const std::string csv =
      averages_csv(averages(rows), {.trapped = true, .fluid = false, .tool = false});
  EXPECT_THAT(csv, testing::HasSubstr("friction_lubricated_sem,liquid_load_share_mean,"
                                      "liquid_load_share_std,liquid_load_share_sem,left_out\n"));
  EXPECT_THAT(csv, testing::HasSubstr(",0.25,0.1767766952966369,0.125,\n"));
  EXPECT_THAT(averages_csv(averages(rows)), testing::Not(testing::HasSubstr("liquid")));
}

TEST(ResultsCsv, PutsColumnsOfAFlowBehindTheAgreedOnes) {
  const std::string agreed = results_csv({});
  const std::string flowing = results_csv({}, {.trapped = false, .fluid = true, .tool = false});
  EXPECT_EQ(flowing, agreed.substr(0, agreed.size() - 1) +
                         ",sliding_speed_m_per_s,fluid_load_share,fluid_contact_area_fraction,"
                         "fluid_mean_gap_m,friction_solid,friction_viscous,friction_mixed,"
                         "fluid_load_error,fluid_gap_error,fluid_pressure_error,"
                         "fluid_converged\n");
}

TEST(ResultsCsv, HasTheAgreedColumns) {
  EXPECT_EQ(results_csv({}),
            "case_id,scan,group,mean_pressure_Pa,lubricant_density_g_per_m2,contact_area_fraction,"
            "contact_area_fraction_pixels,saturated_area_fraction,mean_gap_m,lubricated_share,"
            "spill_over_fraction,friction_dry,friction_lubricated,certificate,converged\n");
}

/// The mean over the scans of the spread over the places of the tool, where every scan has one.
TEST(AveragesCsv, HasTheSpreadOverThePlacesOfATool) {
  std::vector<Row> rows{row("A", 5e6, 0.25), row("A", 5e6, 0.35)};
  for (Row& one : rows) one.tool.emplace();
  rows[0].tool->spread = cases::ToolSpread{0.01, 0.125, 0.5};
  rows[1].tool->spread = cases::ToolSpread{0.03, 0.375, 0.25};
  const std::vector<Average> means = averages(rows);
  ASSERT_TRUE(means.front().tool_spread.has_value());
  EXPECT_DOUBLE_EQ(means.front().tool_spread->area_fraction, 0.02);
  EXPECT_DOUBLE_EQ(means.front().tool_spread->friction_dry, 0.25);
  EXPECT_DOUBLE_EQ(means.front().tool_spread->friction_lubricated, 0.375);
  const std::string csv = averages_csv(means, {.trapped = false, .fluid = false, .tool = true});
  EXPECT_NE(csv.find("friction_dry_std_of_places"), std::string::npos);
  rows[1].tool->spread.reset();
  EXPECT_FALSE(averages(rows).front().tool_spread.has_value());
}

TEST(AveragesCsv, SaysWhyAFrictionTableLeavesARowOut) {
  Row unsettled = row("A", 5e6, 0.25);
  unsettled.converged = false;
  const std::string csv = averages_csv(averages({unsettled}));
  EXPECT_NE(csv.find(",not-converged\n"), std::string::npos) << csv;
}

}  // namespace
}  // namespace tabor::study
