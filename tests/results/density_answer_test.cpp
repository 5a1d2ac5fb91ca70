#include "tabor/results/density_answer.hpp"

#include <gmock/gmock.h>

#include <cmath>

namespace tabor::results {
namespace {

using testing::HasSubstr;
using testing::Not;

/// A fifth of the contact is wet from 0.05 to 1.15 g/m^2, less before and all behind.
cases::DensityCurve curve() {
  cases::DensityCurve curve;
  curve.friction_dry = 0.3;
  curve.lubricant_densities = {1e-5, 5e-5, 1.15e-3, 1.2e-3, 1e-2};
  curve.lubricated_shares = {0.1, 0.2, 0.2, 0.35, 1};
  curve.friction_lubricated = {0.27, 0.24, 0.24, 0.195, 0};
  curve.plateau = cases::Plateau{5e-5, 1.15e-3, 0.8};
  return curve;
}

TEST(DensityAnswer, GivesTheEdgesAndTheWetShareOfWhatIsAsked) {
  const std::string sentence =
      sentence_of(curve(), {{1e-5, 0.1}, {4.5e-4, 0.2}, {1.05e-3, 0.203}, {1.2e-3, 0.35}});
  EXPECT_EQ(
      sentence,
      "the pockets under the contacts are full from 0.05 g/m^2 on (friction 0.24); above 1.15 "
      "to 1.2 g/m^2 the oil level reaches the contacts; 0.01 g/m^2 (10 % wet) lies below, "
      "where fewer pockets are full; 0.45 g/m^2 (20 % wet) and 1.05 g/m^2 (20.3 % wet) lie "
      "between, where the density hardly matters; 1.2 g/m^2 (35 % wet) lies beyond, where "
      "oil covers more of the contacts");
}

TEST(DensityAnswer, DecidesByTheWetShareAndNotByTheDensity) {
  // The film that was computed at 1.3 g/m^2 wets no more than the plateau, that at 0.1 less.
  const std::string sentence = sentence_of(curve(), {{1.3e-3, 0.195}, {1e-4, 0.15}});
  EXPECT_THAT(sentence, HasSubstr("1.3 g/m^2 (19.5 % wet) lies between"));
  EXPECT_THAT(sentence,
              HasSubstr("0.1 g/m^2 (15 % wet) wets less, as single droplets miss pockets"));
  EXPECT_EQ(place_of(curve(), 1 - 0.8 * 1.0101), Place::below);
  EXPECT_EQ(place_of(curve(), 1 - 0.8 * 1.0099), Place::plateau);
  EXPECT_EQ(place_of(curve(), 1 - 0.8 * 0.9901), Place::plateau);
  EXPECT_EQ(place_of(curve(), 1 - 0.8 * 0.9899), Place::beyond);
}

TEST(DensityAnswer, SaysWhatIsThereWhereACurveHasNoEdge) {
  cases::DensityCurve flat = curve();
  flat.plateau = cases::Plateau{1e-5, 1e-2, 0.8};
  EXPECT_THAT(sentence_of(flat, {}), HasSubstr("full at 0.01 g/m^2 already"));
  EXPECT_THAT(sentence_of(flat, {}), Not(HasSubstr("reaches the contacts")));
  EXPECT_THAT(sentence_of(flat, {{1e-4, 0.2}}), HasSubstr("(20 % wet) lies there, where the den"));
  cases::DensityCurve dry = curve();
  dry.plateau->value = 1;
  EXPECT_THAT(
      sentence_of(dry, {{1e-4, 0.001}}),
      HasSubstr("hardly any contact is wet up to 1.15 g/m^2; above 1.15 to 1.2 g/m^2 the oil "
                "level reaches the contacts; 0.1 g/m^2 (0.1 % wet) lies there, where "
                "friction is nearly that without oil"));
  EXPECT_EQ(word_of_place(dry, 0.001), "dry");
  EXPECT_EQ(word_of_place(curve(), 0.2), "plateau");
  EXPECT_EQ(word_of_place(curve(), 0.35), "beyond");
  dry.plateau.reset();
  EXPECT_EQ(word_of_place(dry, 0.2), "no plateau");
  EXPECT_EQ(sentence_of(dry, {{9e-4, 0.2}}), "friction changes with the density throughout");
  EXPECT_FALSE(place_of(dry, 0.2));
}

TEST(DensityAnswer, TakesTheWetShareOfAPointOrBetweenTwo) {
  EXPECT_EQ(lubricated_share_at(curve(), 1.2e-3), 0.35);
  EXPECT_EQ(lubricated_share_at(curve(), std::nextafter(1.2e-3, 0)), 0.35);
  EXPECT_NEAR(lubricated_share_at(curve(), std::sqrt(1.15e-3 * 1.2e-3)), 0.275, 1e-12);
  EXPECT_EQ(lubricated_share_at(curve(), 1e-9), 0.1);
  EXPECT_EQ(lubricated_share_at(curve(), 1), 1);
}

TEST(DensityAnswer, AsksForEachDensityOfTheRecordsOnce) {
  cases::FrictionRecord one;
  one.mean_pressure = 5e6;
  one.lubricant_density = 9e-4;
  one.lubricated_share = 0.25;
  cases::FrictionRecord none = one, other = one;
  none.lubricant_density = 0;
  other.mean_pressure = 7e6;
  const auto asked = asked_at(5e6, {one, none, other, one});
  ASSERT_EQ(asked.size(), 1U);
  EXPECT_EQ(asked.front().lubricant_density, 9e-4);
  EXPECT_EQ(asked.front().lubricated_share, 0.25);
}

TEST(DensityAnswer, FindsWhereFrictionLiesFarthestFromTheLimit) {
  cases::DensityCurve at_two = curve();
  at_two.mean_pressure = 2e6;
  cases::DensityCurve at_five = curve();
  at_five.mean_pressure = 5e6;
  cases::FrictionRecord near;
  near.mean_pressure = 2e6;
  near.lubricant_density = std::nextafter(1.15e-3, 1);  // a unit was changed
  near.friction_lubricated = 0.2401;
  cases::FrictionRecord far = near, off = near, elsewhere = near;
  far.mean_pressure = 5e6;
  far.lubricant_density = 1.2e-3;
  far.friction_lubricated = 0.1948;
  off.lubricant_density = 1.17e-3;  // no point of the curve
  off.friction_lubricated = 0.1;
  elsewhere.mean_pressure = 7e6;  // no curve
  elsewhere.friction_lubricated = 0.1;
  const auto most = difference_from_limit({at_two, at_five}, {near, off, far, elsewhere});
  ASSERT_TRUE(most);
  EXPECT_NEAR(most->friction, 2e-4, 1e-12);
  EXPECT_EQ(most->mean_pressure, 5e6);
  EXPECT_EQ(most->lubricant_density, 1.2e-3);
  EXPECT_FALSE(difference_from_limit({at_two}, {off, elsewhere}));
  EXPECT_FALSE(difference_from_limit({}, {near}));
}

}  // namespace
}  // namespace tabor::results
