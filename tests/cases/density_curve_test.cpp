#include "tabor/cases/density_curve.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tabor/cases/states.hpp"

namespace tabor::cases {
namespace {

CaseSettings settings() {
  CaseSettings settings;
  settings.contact = {.youngs_modulus = 70e9, .poissons_ratio = 0.33};
  settings.friction.shear_strength = 70e6;
  return settings;
}

/// A plateau at height 0 with a pit of one pixel, 10 nm deep, and a valley of half the area, 1 um
/// deep. Everything on the plateau touches, the pit too.
struct Stage {
  topography::Topography surface;
  std::vector<Touching> contacts;
};

Stage plateau_with_a_pit_and_a_valley() {
  Stage stage;
  stage.surface.grid = {8, 8, 8e-6, 8e-6};
  stage.surface.height = Field::Zero(8, 8);
  stage.surface.height.bottomRows(4) = -1e-6;
  stage.surface.height(1, 3) = -10e-9;
  Touching touching;
  touching.mask = Mask::Constant(8, 8, false);
  touching.mask.topRows(4) = true;
  touching.summary.mean_pressure = 1e6;
  touching.summary.contact_area_fraction = touching.summary.contact_area_fraction_pixels = 0.5;
  stage.contacts.push_back(touching);
  return stage;
}

TEST(DensityCurve, KnowsThePitAndTheValley) {
  const Stage stage = plateau_with_a_pit_and_a_valley();
  const auto curves = density_curves(stage.surface, stage.contacts, settings());
  ASSERT_EQ(curves.size(), 1U);
  const DensityCurve& curve = curves.front();
  // Vanishing droplets wet the pit at once; the valley, 1 um deep on half of the pixels, reaches
  // the plateau when 0.5 um have rained.
  for (std::size_t i = 0; i < curve.lubricant_densities.size(); ++i) {
    const double film = curve.lubricant_densities[i] / 900;
    if (film < 0.49e-6) {
      EXPECT_DOUBLE_EQ(curve.lubricated_shares[i], 1.0 / 32) << film;
    }
    if (film > 0.51e-6) {
      EXPECT_DOUBLE_EQ(curve.lubricated_shares[i], 1) << film;
    }
    EXPECT_DOUBLE_EQ(curve.friction_lubricated[i],
                     curve.friction_dry * (1 - curve.lubricated_shares[i]));
  }
  // 0.45 g/m^2 on 900 kg/m^3 is the level of the plateau itself: the last dose that wets no more.
  ASSERT_TRUE(curve.plateau);
  EXPECT_DOUBLE_EQ(curve.plateau->last, 0.45e-3);
}

TEST(DensityCurve, HasRoundDensitiesAtMostFivePerCentApartAndThoseAskedFor) {
  const Stage stage = plateau_with_a_pit_and_a_valley();
  CaseSettings asking = settings();
  // 0.1 g/m^2 as a factor of units may leave it; 5 kg/m^2 drowns the surface; none without oil.
  asking.film.lubricant_densities = {5, std::nextafter(1e-4, 1), 1.234e-4, 0};
  const auto curves = density_curves(stage.surface, stage.contacts, asking);
  const std::vector<double>& all = curves.front().lubricant_densities;
  EXPECT_TRUE(std::is_sorted(all.begin(), all.end()));
  EXPECT_EQ(all.front(), 1e-6);
  EXPECT_EQ(all.back(), 5);
  for (const double density : {1e-5, 1e-4, 4.5e-4, 1.234e-4}) {
    EXPECT_EQ(std::count(all.begin(), all.end(), density), 1) << density;
  }
  EXPECT_EQ(
      std::count_if(all.begin(), all.end(), [](double one) { return are_same_density(one, 1e-4); }),
      1);
  for (std::size_t i = 1; i + 1 < all.size(); ++i) EXPECT_LE(all[i], 1.0501 * all[i - 1]);
}

TEST(DensityCurve, HasThePlateauOfThePocketsHoweverMuchOilIsAskedFor) {
  const Stage stage = plateau_with_a_pit_and_a_valley();
  CaseSettings much = settings();
  much.film.lubricant_densities = {0.1, 1, 10};  // a range of drowned contact 100 times as long
  const auto curves = density_curves(stage.surface, stage.contacts, much);
  ASSERT_TRUE(curves.front().plateau);
  EXPECT_DOUBLE_EQ(curves.front().plateau->last, 0.45e-3);
  EXPECT_DOUBLE_EQ(curves.front().plateau->value, 31.0 / 32);
}

TEST(DensityCurve, CallsNoShortStretchAPlateau) {
  DensityCurve falling;
  for (int i = 0; i < 200; ++i) {
    falling.lubricant_densities.push_back(1e-6 * std::pow(1.05, i));
    falling.lubricated_shares.push_back(0.004 * i);  // within 1 % of its mean over a few steps
  }
  EXPECT_FALSE(plateau_of(falling));
}

TEST(DensityCurve, HasOnItsPlateauExactlyThePointsWithinTheTolerance) {
  DensityCurve curve;
  for (int i = 0; i < 60; ++i) {
    curve.lubricant_densities.push_back(1e-5 * std::pow(1.05, i));
    curve.lubricated_shares.push_back(0.2 +
                                      3e-6 * std::pow(std::abs(i - 30), 3) * (i < 30 ? -1 : 1));
  }
  curve.plateau = plateau_of(curve);
  ASSERT_TRUE(curve.plateau);
  for (std::size_t i = 0; i < 60; ++i) {
    const double density = curve.lubricant_densities[i];
    const bool is_on = density >= curve.plateau->first && density <= curve.plateau->last;
    const double apart = std::abs(1 - curve.lubricated_shares[i] - curve.plateau->value);
    EXPECT_EQ(is_on, apart <= kPlateauTolerance * curve.plateau->value) << i;
  }
}

TEST(DensityCurve, HasTheSamePlateauWithABoundaryFilm) {
  const Stage stage = plateau_with_a_pit_and_a_valley();
  CaseSettings sheared = settings();
  sheared.friction.boundary_shear_share = 1;
  const auto slippery = density_curves(stage.surface, stage.contacts, settings());
  const auto rough = density_curves(stage.surface, stage.contacts, sheared);
  ASSERT_TRUE(rough.front().plateau);
  EXPECT_EQ(rough.front().plateau->last, slippery.front().plateau->last);
  EXPECT_DOUBLE_EQ(rough.front().friction_lubricated.back(), rough.front().friction_dry);
}

TEST(DensityCurve, IsEmptyOnASurfaceWithoutHeights) {
  Stage stage = plateau_with_a_pit_and_a_valley();
  stage.surface.height.setZero();
  EXPECT_TRUE(density_curves(stage.surface, stage.contacts, settings()).empty());
  const WettingDoses doses = wetting_doses(stage.surface, settings().film, Mask());
  EXPECT_TRUE(lubricated_shares(doses, stage.contacts.front().mask).empty());
}

}  // namespace
}  // namespace tabor::cases
