// Sliding with its settings: states along the way, friction with ploughing, and what is rejected.
#include "tabor/cases/slide/slide.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "cases/small_sheet.hpp"
#include "support/rejection.hpp"
#include "tabor/cases/states.hpp"
#include "tabor/synthesis/synthesis.hpp"

namespace tabor::cases {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

CaseSettings aluminium() {
  CaseSettings settings;
  settings.mean_pressures = {10e6};
  settings.contact = test::aluminium();
  settings.contact.tool.tool = "ground:Sa=0.1um,groove-length=50um,length=100um";
  settings.film.lubricant_densities = {0.2e-3};
  settings.friction = {.shear_strength = 70e6};
  return settings;
}

TEST(Slide, HasStatesFromThePressingToTheEnd) {
  std::vector<double> received;
  const SlideResult result =
      slide(test::small_sheet(), aluminium(), {.distance = 12e-6, .step = 2e-6, .every = 4e-6},
            {.receive = [&](const SlideState& one) { received.push_back(one.numbers.distance); }});
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
  const SlideResult result = slide(test::small_sheet(), settings, {.distance = 6e-6, .step = 2e-6});
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
  const SlideResult first = slide(test::small_sheet(), settings, {.distance = 4e-6, .step = 2e-6});
  EXPECT_NEAR(first.after.height.mean(), test::small_sheet().height.mean(), 1e-18);
  EXPECT_THAT(first.after.history.back(), HasSubstr("slide: 4"));
  CaseSettings further = settings;
  further.contact.tool.tool_x = 4e-6;
  const SlideResult second = slide(first.after, further, {.distance = 2e-6, .step = 2e-6});
  const SlideResult at_once =
      slide(test::small_sheet(), settings, {.distance = 6e-6, .step = 2e-6});
  EXPECT_NEAR(second.after.height.maxCoeff(), at_once.after.height.maxCoeff(), 1e-10);
}

TEST(Slide, SqueezesOilOutInASecondAccount) {
  const CaseSettings settings = aluminium();
  const SlideResult both = slide(test::small_sheet(), settings, {.distance = 12e-6, .step = 2e-6});
  const double oil = deposition::mean_film(0.2e-3, settings.film.oil_density);
  for (const SlideRecord& one : both.states) {
    EXPECT_GE(one.friction_squeezed, one.friction_lubricated - 1e-12);
    EXPECT_LE(one.friction_squeezed, one.friction_dry + 1e-12);
    EXPECT_NEAR((one.squeezed_film + one.squeezed_away) / oil, 1, 1e-4);  // droplets are whole
  }
  EXPECT_EQ(both.states.front().friction_squeezed, both.states.front().friction_lubricated);
  EXPECT_LT(both.states.back().squeezed_share, both.states.front().squeezed_share);
  const SlideResult kept = slide(test::small_sheet(), settings,
                                 {.distance = 12e-6, .step = 2e-6, .liquid = SlidingOil::kept});
  EXPECT_TRUE(std::isnan(kept.states.back().friction_squeezed));
  EXPECT_EQ(kept.states.back().friction_lubricated, both.states.back().friction_lubricated);
}

TEST(Slide, LetsTrappedOilCarryLoad) {
  CaseSettings settings = aluminium();
  settings.film.lubricant_densities = {0.1e-3};
  settings.mean_pressures = {60e6};
  const SlideSettings sliding{.distance = 8e-6, .step = 2e-6};
  const SlideResult without = slide(test::small_sheet(), settings, sliding);
  settings.trapped.trapped = true;
  const SlideResult with = slide(test::small_sheet(), settings, sliding);
  EXPECT_FALSE(without.states.back().trapped);
  ASSERT_TRUE(with.states.front().trapped);
  EXPECT_GT(with.states.front().trapped->load_share, 0);
  EXPECT_LT(with.states.front().friction_lubricated, without.states.front().friction_lubricated);
  EXPECT_TRUE(with.converged);
}

TEST(Slide, TrapsWhatContactsLeaveOfTheOil) {
  CaseSettings settings = aluminium();
  settings.film.lubricant_densities = {0.1e-3};
  settings.mean_pressures = {60e6};
  settings.trapped.trapped = true;
  const auto slid = [&](SlidingOil liquid) {
    return slide(test::small_sheet(), settings, {.distance = 8e-6, .step = 2e-6, .liquid = liquid});
  };
  const SlideResult both = slid(SlidingOil::both);
  const SlideResult squeezed = slid(SlidingOil::squeezed);
  EXPECT_EQ(squeezed.states.front().friction_squeezed, both.states.front().friction_squeezed);
  EXPECT_TRUE(std::isnan(squeezed.states.back().friction_lubricated));
  EXPECT_GE(squeezed.states.back().friction_squeezed, both.states.back().friction_lubricated);
  EXPECT_NE(squeezed.states.back().trapped->load_share, both.states.back().trapped->load_share);
}

TEST(Slide, WearsAnElasticSheet) {
  CaseSettings settings = aluminium();
  settings.contact.saturation_pressure.reset();
  settings.film.lubricant_densities.clear();
  const SlideResult worn = slide(test::small_sheet(), settings,
                                 {.distance = 8e-6, .step = 2e-6, .wear_coefficient = 1e-13});
  EXPECT_NEAR(worn.states.back().worn_volume / (1e-13 * 10e6 * 8e-6), 1, 1e-9);
  EXPECT_EQ(worn.states.back().moved_volume, 0);
  EXPECT_THAT(worn.references, Contains("archard1953"));
}

TEST(Slide, HardensASheet) {
  CaseSettings settings = aluminium();
  settings.film.lubricant_densities.clear();
  const SlideSettings soft{.distance = 8e-6, .step = 2e-6};
  SlideSettings hard = soft;
  hard.hardening = 1e14;
  std::vector<Field> caps;
  const SlideRun wanted{.receive =
                            [&](const SlideState& state) {
                              if (state.maps != nullptr) {
                                caps.push_back(state.maps->saturation_pressure);
                              }
                            },
                        .wants_maps = true};
  const SlideResult found = slide(test::small_sheet(), settings, hard, wanted);
  const SlideResult without = slide(test::small_sheet(), settings, soft);
  EXPECT_EQ(found.states.front().highest_saturation_pressure,
            *settings.contact.saturation_pressure);
  EXPECT_EQ(without.states.back().highest_saturation_pressure,
            *settings.contact.saturation_pressure);
  EXPECT_GT(found.states.back().highest_saturation_pressure,
            1.01 * *settings.contact.saturation_pressure);
  EXPECT_LT(found.states.back().moved_volume, without.states.back().moved_volume);
  EXPECT_THAT(codes_of(without.warnings), Contains("clamp"));
  EXPECT_THAT(codes_of(found.warnings), Not(Contains("clamp")));  // tau_y/p_sat is of no pixel
  ASSERT_EQ(caps.size(), 2U);
  EXPECT_EQ(caps.front().size(), 0);  // one for all still
  EXPECT_EQ(caps.back().maxCoeff(), found.states.back().highest_saturation_pressure);
}

TEST(Slide, SaysWhetherItBecameSteady) {
  const SlideResult result = slide(test::small_sheet(), aluminium(),
                                   {.distance = 8e-6, .step = 2e-6, .until_steady = true});
  EXPECT_EQ(result.steady, false);
  EXPECT_THAT(codes_of(result.warnings), Contains("not-steady"));
  // A tool that is smooth along x changes nothing after the first period.
  CaseSettings settings = aluminium();
  settings.contact.tool.tool = "ground:Sa=0.1um,groove-length=1m,length=64um";
  const SlideResult steady = slide(test::small_sheet(), settings,
                                   {.distance = 640e-6, .step = 16e-6, .until_steady = true});
  EXPECT_EQ(steady.steady, true);
  EXPECT_LT(steady.states.back().distance, 640e-6);
  const SlideResult limited =  // without a distance: at most 20 lengths of the tool
      slide(test::small_sheet(), settings, {.step = 16e-6, .until_steady = true});
  EXPECT_EQ(limited.states.back().distance, steady.states.back().distance);
}

TEST(Slide, ChangesTheSheetMoreUnderMorePressure) {
  // The trend of the figure 4 of Costagliola et al. 2021: short waves along x lose.
  const auto lost = [](double pressure) {
    CaseSettings settings = aluminium();
    settings.mean_pressures = {pressure};
    settings.film.lubricant_densities.clear();
    const SlideResult result =
        slide(test::small_sheet(), settings, {.distance = 40e-6, .step = 2e-6});
    double change = 0;
    for (std::size_t i = 0; i < result.before.q_x.size(); ++i) {
      const double wavelength = 2 * std::numbers::pi / result.before.q_x[i];
      if (wavelength > 4e-6 || wavelength < 2.1e-6) continue;
      change += std::log(result.spectra.back().density_x[i] / result.before.density_x[i]);
    }
    return change;
  };
  const double little = lost(2e6);
  const double much = lost(15e6);
  EXPECT_LT(little, 0);
  EXPECT_LT(much, little);
}

TEST(Slide, FindsAStepWhoseBoundsAreNear) {
  const SlideResult result = slide(test::small_sheet(), aluminium(), {.distance = 8e-6});
  EXPECT_GE(result.step, 1e-6 * (1 - 1e-9));
  EXPECT_LE(result.step, 8e-6);
}

TEST(Slide, IsRejectedWithoutWhatItNeeds) {
  const auto remedy = [](const CaseSettings& settings, const SlideSettings& sliding) {
    const auto found = objection(sliding, settings, test::own_name);
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
  settings.film.lubricant_densities.clear();
  settings.trapped.trapped = true;
  EXPECT_THAT(remedy(settings, some), HasSubstr("needs oil"));
  EXPECT_THAT(remedy(aluminium(), {.distance = 1e-6, .maps_at = {2e-6}}), HasSubstr("distance"));
  EXPECT_THAT(remedy(aluminium(), {.distance = 1e-6, .wear_coefficient = 0}), HasSubstr("zero"));
  settings = aluminium();
  settings.contact.load_path = true;
  EXPECT_THAT(remedy(settings, some), HasSubstr("load_path"));
  EXPECT_THAT(remedy(aluminium(), {}), HasSubstr("until_steady"));
  EXPECT_THAT(remedy(aluminium(), {.distance = 0}), HasSubstr("more than zero"));
  EXPECT_THAT(remedy(aluminium(), {.distance = 1e-6, .step = 2e-6}), HasSubstr("distance"));
  const auto message = [](const SlideSettings& sliding) {
    return test::rejection([&] { slide(test::small_sheet(), aluminium(), sliding); });
  };
  EXPECT_THAT(message({.distance = 1e-9}), HasSubstr("pixel"));
  EXPECT_THAT(message({.distance = 1}), HasSubstr("100000 pixels"));
  EXPECT_THAT(message({.distance = 1e-5, .step = 1e-9}), HasSubstr("pixel"));
}

TEST(Slide, WarnsOfMaterialThatIsWornOff) {
  const auto codes = [](const sliding::Ploughing& all) {
    return codes_of(of_sliding(all, 1e7, 1e-6, 1e-4));
  };
  EXPECT_THAT(codes({.distance = 1e-4, .work = 1, .lower = 1, .upper = 1, .lost = 1e-7}),
              Contains("milling"));
  EXPECT_THAT(codes({.distance = 1e-4, .work = 1, .lower = 0.5, .upper = 1}),
              Contains("tool-pixel"));
  EXPECT_TRUE(codes({.distance = 1e-4, .work = 1, .lower = 0.9, .upper = 1}).empty());
  EXPECT_THAT(codes({.distance = 3e-4, .work = 1, .lower = 0.9, .upper = 1}),
              Contains("tool-envelope"));
}

// In whole pixels, of which the last step has what is left.
TEST(Slide, EndsWhereItIsStoppedIfThatIsWanted) {
  const SlideSettings sliding{.distance = 12e-6, .step = 2e-6, .every = 4e-6};
  const SlideResult whole = slide(test::small_sheet(), aluminium(), sliding);
  EXPECT_FALSE(whole.interrupted);
  int n_steps = 0;
  const Observer observer = [&n_steps](const Progress& progress) {
    n_steps += progress.stage.starts_with("slide,") ? 1 : 0;
    return n_steps < 3;  // after the first step two more begin: the third is stopped
  };
  const SlideResult part =
      slide(test::small_sheet(), aluminium(), sliding, {.ends_when_stopped = true}, observer);
  EXPECT_TRUE(part.interrupted);
  ASSERT_EQ(part.states.size(), 2U);  // pressed, and after 4 um
  EXPECT_EQ(part.states[1].friction_dry, whole.states[1].friction_dry);
  EXPECT_EQ(part.steps, 3U);
  n_steps = 0;
  EXPECT_THROW(slide(test::small_sheet(), aluminium(), sliding, {}, observer), Interrupted);
}

TEST(Slide, EndsAtItsDistance) {
  const auto slid = [](double distance, double step) {
    return slide(test::small_sheet(), aluminium(), {.distance = distance, .step = step}, {});
  };
  const SlideResult odd = slid(9e-6, 4e-6);
  EXPECT_EQ(odd.steps, 3U);
  EXPECT_DOUBLE_EQ(odd.step, 4e-6);
  EXPECT_NEAR(odd.states.back().distance, 9e-6, 1e-12);
  EXPECT_NEAR(slid(3.4e-6, 2e-6).states.back().distance, 3e-6, 1e-12);
}

}  // namespace
}  // namespace tabor::cases
