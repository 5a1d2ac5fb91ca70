#include "tabor/analysis/density_curve.hpp"

#include <gmock/gmock.h>

#include "tabor/analysis/states.hpp"

namespace tabor::analysis {
namespace {

using testing::HasSubstr;

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
  ASSERT_TRUE(curve.plateau);
  EXPECT_NEAR(curve.plateau->last, 0.45e-3, 0.06e-3);
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

TEST(DensityCurve, SaysWhereTheAskedDensitiesLie) {
  DensityCurve curve;
  curve.friction_dry = 0.3;
  curve.lubricant_densities = {5e-5, 1.2e-3, 1e-2};
  curve.friction_lubricated = {0.25, 0.25, 0};
  curve.plateau = Plateau{5e-5, 1.2e-3, 0.8};
  const std::string sentence = sentence_of(curve, {1e-5, 4.5e-4, 9e-4, 2e-3});
  EXPECT_THAT(sentence, HasSubstr("full from 0.05 g/m^2 (friction 0.25)"));
  EXPECT_THAT(sentence, HasSubstr("the next change comes at 1.2 g/m^2"));
  EXPECT_THAT(sentence, HasSubstr("0.01 g/m^2 lies below"));
  EXPECT_THAT(sentence, HasSubstr("0.45 g/m^2 and 0.9 g/m^2 lie between"));
  EXPECT_THAT(sentence, HasSubstr("2 g/m^2 lies beyond"));
  curve.plateau->value = 1;
  EXPECT_THAT(sentence_of(curve, {}), HasSubstr("hardly any contact is wet up to 1.2 g/m^2"));
  curve.plateau.reset();
  EXPECT_EQ(sentence_of(curve, {9e-4}), "friction changes with the density throughout");
}

TEST(DensityCurve, IsEmptyOnASurfaceWithoutHeights) {
  Stage stage = plateau_with_a_pit_and_a_valley();
  stage.surface.height.setZero();
  EXPECT_TRUE(density_curves(stage.surface, stage.contacts, settings()).empty());
}

}  // namespace
}  // namespace tabor::analysis
