// Sliding with its settings: states along the way, friction with ploughing, and what is rejected.
#include "tabor/cases/slide.hpp"

#include <gmock/gmock.h>

#include "support/rejection.hpp"
#include "tabor/cases/states.hpp"
#include "tabor/synthesis/synthesis.hpp"

namespace tabor::cases {
namespace {

using testing::Contains;
using testing::HasSubstr;

std::string same(std::string_view setting) { return std::string(setting); }

topography::Topography sheet() {
  synthesis::SelfAffine recipe;
  recipe.grid = {64, 48, 64e-6, 48e-6};
  recipe.rms_height = 0.5e-6;
  return synthesis::self_affine(recipe);
}

CaseSettings aluminium() {
  CaseSettings settings;
  settings.mean_pressures = {10e6};
  settings.contact = {.youngs_modulus = 70e9, .poissons_ratio = 0.33, .saturation_pressure = 240e6};
  settings.contact.tool.tool = "ground:Sa=0.1um,groove-length=50um,length=100um";
  settings.film.lubricant_densities = {0.2e-3};
  settings.friction = {.shear_strength = 70e6};
  return settings;
}

TEST(Slide, HasStatesFromThePressingToTheEnd) {
  std::vector<double> received;
  const SlideResult result =
      slide(sheet(), aluminium(), {.distance = 12e-6, .step = 2e-6, .every = 4e-6},
            [&](const SlideRecord& one) { received.push_back(one.distance); });
  EXPECT_EQ(result.steps, 6U);
  EXPECT_DOUBLE_EQ(result.step, 2e-6);
  ASSERT_EQ(result.states.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(result.states[i].distance, 4e-6 * static_cast<double>(i), 1e-18);
    EXPECT_EQ(received[i], result.states[i].distance);
  }
  EXPECT_TRUE(std::isnan(result.states[0].friction_ploughing));
  EXPECT_TRUE(result.converged);
  EXPECT_GT(result.states[3].moved_volume, result.states[0].moved_volume);
  EXPECT_EQ(result.states[3].lost_volume, 0);
}

TEST(Slide, AddsPloughingToTheShearOfTheContact) {
  const CaseSettings settings = aluminium();
  const SlideResult result = slide(sheet(), settings, {.distance = 6e-6, .step = 2e-6});
  for (const SlideRecord& one : result.states) {
    const friction::Estimate shear =
        estimate_of(one.contact, one.lubricated_share, settings.contact, settings.friction);
    const double ploughing = one.distance > 0 ? one.friction_ploughing : 0;
    EXPECT_DOUBLE_EQ(one.friction_dry, shear.friction_dry + ploughing);
    EXPECT_DOUBLE_EQ(one.friction_lubricated, shear.friction_lubricated + ploughing);
    if (one.distance == 0) continue;
    EXPECT_LE(one.friction_ploughing_lower, one.friction_ploughing);
    EXPECT_LE(one.friction_ploughing, one.friction_ploughing_upper);
  }
}

TEST(Slide, LeavesASheetThatItCanSlideOn) {
  const CaseSettings settings = aluminium();
  const SlideResult first = slide(sheet(), settings, {.distance = 4e-6, .step = 2e-6});
  EXPECT_NEAR(first.after.height.mean(), sheet().height.mean(), 1e-18);
  EXPECT_THAT(first.after.history.back(), HasSubstr("slide: 4"));
  CaseSettings further = settings;
  further.contact.tool.tool_x = 4e-6;
  const SlideResult second = slide(first.after, further, {.distance = 2e-6, .step = 2e-6});
  const SlideResult at_once = slide(sheet(), settings, {.distance = 6e-6, .step = 2e-6});
  EXPECT_NEAR(second.after.height.maxCoeff(), at_once.after.height.maxCoeff(), 1e-10);
}

TEST(Slide, FindsAStepWhoseBoundsAreNear) {
  const SlideResult result = slide(sheet(), aluminium(), {.distance = 8e-6});
  EXPECT_GE(result.step, 1e-6 * (1 - 1e-9));
  EXPECT_LE(result.step, 8e-6);
}

TEST(Slide, IsRejectedWithoutWhatItNeeds) {
  const auto remedy = [](const CaseSettings& settings, const SlideSettings& sliding) {
    const auto found = objection(sliding, settings, same);
    return found ? found->remedy + found->expected : "";
  };
  const SlideSettings some{.distance = 1e-5};
  EXPECT_EQ(remedy(aluminium(), some), "");
  CaseSettings settings = aluminium();
  settings.contact.tool.tool.reset();
  EXPECT_THAT(remedy(settings, some), HasSubstr("rough tool"));
  settings = aluminium();
  settings.contact.saturation_pressure.reset();
  EXPECT_THAT(remedy(settings, some), HasSubstr("saturation_pressure"));
  settings = aluminium();
  settings.mean_pressures = {1e6, 2e6};
  EXPECT_THAT(remedy(settings, some), HasSubstr("one mean_pressure"));
  settings = aluminium();
  settings.film.lubricant_densities = {1e-4, 2e-4};
  EXPECT_THAT(remedy(settings, some), HasSubstr("one lubricant_density"));
  settings = aluminium();
  settings.contact.load_path = true;
  EXPECT_THAT(remedy(settings, some), HasSubstr("load_path"));
  EXPECT_THAT(remedy(aluminium(), {.distance = 0}), HasSubstr("more than zero"));
  EXPECT_THAT(remedy(aluminium(), {.distance = 1e-6, .step = 2e-6}), HasSubstr("distance"));
  const auto message = [](const SlideSettings& sliding) {
    return test::rejection([&] { slide(sheet(), aluminium(), sliding); });
  };
  EXPECT_THAT(message({.distance = 1e-9}), HasSubstr("pixel"));
  EXPECT_THAT(message({.distance = 1}), HasSubstr("100000 pixels"));
  EXPECT_THAT(message({.distance = 1e-5, .step = 1e-9}), HasSubstr("pixel"));
}

TEST(Slide, WarnsOfMaterialThatIsWornOff) {
  const auto codes = [](const sliding::Ploughing& all) {
    return codes_of(of_sliding(all, 1e7, 1e-6));
  };
  EXPECT_THAT(codes({.distance = 1e-4, .work = 1, .lower = 1, .upper = 1, .lost = 1e-7}),
              Contains("milling"));
  EXPECT_THAT(codes({.distance = 1e-4, .work = 1, .lower = 0.5, .upper = 1}),
              Contains("tool-pixel"));
  EXPECT_TRUE(codes({.distance = 1e-4, .work = 1, .lower = 0.9, .upper = 1}).empty());
}

}  // namespace
}  // namespace tabor::cases
