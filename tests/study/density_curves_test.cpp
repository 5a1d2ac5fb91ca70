#include "tabor/study/density_curves.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "study/example_study.hpp"
#include "tabor/study/record.hpp"
#include "tabor/study/wet_shares.hpp"

namespace tabor::study {
namespace {

using test::ExampleStudy;

ScanCurve curve(const std::string& group, double pressure, const std::vector<double>& wet) {
  ScanCurve one{"scan", group, {}};
  one.curve.mean_pressure = pressure;
  one.curve.friction_dry = 0.3;
  for (std::size_t i = 0; i < wet.size(); ++i) {
    one.curve.lubricant_densities.push_back(1e-4 * static_cast<double>(i + 1));
    one.curve.lubricated_shares.push_back(wet[i]);
    one.curve.friction_lubricated.push_back(0.3 * (1 - wet[i]));
  }
  return one;
}

Row row(const std::string& group, double pressure, double density, double wet) {
  Row one;
  one.group = group;
  one.mean_pressure = pressure;
  one.lubricant_density = density;
  one.lubricated_share = wet;
  one.converged = true;
  return one;
}

TEST(DensityCurves, AreAveragedByGroupAndPressureWhereAllScansReach) {
  const std::vector<Row> rows = {row("side A", 5e6, 9e-4, 0.2),   row("side A", 7e6, 9e-4, 0.5),
                                 row("side A", 5e6, 4.5e-4, 0.1), row("side A", 5e6, 9e-4, 0.3),
                                 row("side A", 5e6, 0, 0),        row("third", 5e6, 9e-4, 0.9)};
  const std::vector<GroupCurve> means =
      average_curves({curve("side A", 5e6, {0.1, 0.2, 0.2, 0.9}), curve("other", 5e6, {0.5}),
                      curve("side A", 5e6, {0.1, 0.4, 0.4})},
                     rows);
  ASSERT_EQ(means.size(), 2u);
  EXPECT_EQ(means[0].group, "side A");
  EXPECT_EQ(means[0].n, 2u);
  EXPECT_THAT(means[0].curve.lubricant_densities, testing::SizeIs(3));
  EXPECT_THAT(
      means[0].curve.lubricated_shares,
      testing::ElementsAre(testing::DoubleEq(0.1), testing::DoubleEq(0.3), testing::DoubleEq(0.3)));
  EXPECT_NEAR(means[0].friction_lubricated[1].mean, 0.21, 1e-15);
  EXPECT_NEAR(means[0].friction_lubricated[1].standard_deviation, 0.06 / std::sqrt(2.0), 1e-15);
  ASSERT_EQ(means[0].asked.size(), 2u);
  EXPECT_EQ(means[0].asked[0].lubricant_density, 4.5e-4);
  EXPECT_EQ(means[0].asked[1].lubricant_density, 9e-4);
  EXPECT_DOUBLE_EQ(means[0].asked[1].lubricated_share, 0.25);
  EXPECT_EQ(means[1].n, 1u);
  EXPECT_TRUE(std::isnan(means[1].friction_lubricated[0].standard_deviation));
  EXPECT_TRUE(means[1].asked.empty());  // no scan of the study is in that group
  EXPECT_EQ(points_of(means).size(), 4u);
}

TEST(DensityCurves, AreAveragedAtTheDensitiesThatAllScansHave) {
  ScanCurve one = curve("side A", 5e6, {0.1, 0.2, 0.3});
  ScanCurve other = one;
  other.curve.lubricant_densities[1] = 2.5e-4;  // asked of this scan alone
  other.curve.lubricant_densities[2] = std::nextafter(3e-4, 1);
  const std::vector<GroupCurve> means = average_curves({one, other}, {});
  ASSERT_THAT(means.front().curve.lubricant_densities,
              testing::ElementsAre(1e-4, testing::DoubleEq(3e-4)));
  EXPECT_DOUBLE_EQ(means.front().curve.lubricated_shares[1], 0.3);
}

TEST(DensityCurves, TheirPlacesAreThoseOfTheMeanWetShares) {
  GroupCurve one{"side A", 2,  curve("side A", 5e6, {0.2}).curve,
                 {},       {}, {{1e-4, 0.1}, {2e-4, 0.2}}};
  EXPECT_EQ(places_of({one})[0].place, "");
  one.curve.plateau = cases::Plateau{1e-4, 3e-4, 0.8};
  const std::vector<PlacePoint> places = places_of({one});
  ASSERT_EQ(places.size(), 2u);
  EXPECT_EQ(places[0].place, "below");
  EXPECT_EQ(places[1].place, "plateau");
  EXPECT_EQ(places[1].lubricated_share, 0.2);
}

TEST(DensityCurves, WetSharesComeBackAsTheyWereWritten) {
  const ExampleStudy example;
  const engine::Store store(example.results(), engine::Store::Use::alone);
  const engine::Task task = engine::make_task("wetshares", "json", "text");
  write_wet_shares(store, task, {{1e-6, 1e-3}, {0.1, 1.0 / 3}});
  const WetShares back = read_wet_shares(store, task);
  EXPECT_THAT(back.lubricant_densities, testing::ElementsAre(1e-6, 1e-3));
  EXPECT_THAT(back.lubricated_shares, testing::ElementsAre(0.1, 1.0 / 3));
}

TEST(DensityCurves, RejectsWetSharesThatWereChanged) {
  const ExampleStudy example;
  const engine::Store store(example.results(), engine::Store::Use::alone);
  const engine::Task task = engine::make_task("wetshares", "json", "text");
  write_wet_shares(store, task, {{1e-6}, {0.125}});
  test::put_bytes(store.path(task),
                  test::replaced(test::bytes_of(store.path(task)), "0.125", "0.25"));
  EXPECT_THROW(read_wet_shares(store, task), InputError);
  write_wet_shares(store, task, {{1e-6}, {0.125, 0.5}});
  EXPECT_THROW(read_wet_shares(store, task), InputError);
  EXPECT_THROW(read_wet_shares(store, engine::make_task("wetshares", "json", "other")), InputError);
}

}  // namespace
}  // namespace tabor::study
