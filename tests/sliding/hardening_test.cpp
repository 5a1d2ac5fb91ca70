// A sheet whose saturation pressure rises where it has yielded.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "sliding/rough.hpp"
#include "support/rejection.hpp"
#include "support/validation.hpp"
#include "tabor/contact/contact.hpp"

namespace tabor::sliding {
namespace {

using testing::HasSubstr;

/// 100 MPa/um: depths here are some 10 nm.
constexpr double kHardening = 1e14;

TEST(Hardening, RaisesTheSaturationPressureByTheDepthThatHasYielded) {
  // What yields leaves this sheet, so that its heights say how deep that is.
  Rough rough(Displaced::lost, 40e6);
  rough.problem.hardening = kHardening;
  Slider slider(*rough.elasticity, rough.problem);
  slider.press();
  EXPECT_EQ(slider.highest_cap(), kCap);
  double worst = 0;
  for (int i = 0; i < 4; ++i) {
    const Field yielded = rough.problem.sheet - slider.sheet();
    slider.advance(2);
    const Field expected = kCap + kHardening * yielded;
    worst = std::max(worst, (slider.caps_map() / expected - 1).abs().maxCoeff());
    EXPECT_GT(expected.maxCoeff(), 1.02 * kCap);
    EXPECT_TRUE((slider.state().pressure <= slider.caps_map() * (1 + 1e-12)).all());
  }
  test::expect_within("Sliding", "rough sheet that hardens, 100 MPa/um, four steps",
                      "saturation pressures, relative", "p_sat + H times the depth yielded", worst,
                      1e-9);
}

TEST(Hardening, KeepsPloughingBetweenItsBounds) {
  for (const Displaced displaced : {Displaced::near, Displaced::lost}) {
    Rough rough(displaced);
    rough.problem.hardening = kHardening;
    Slider slider(*rough.elasticity, rough.problem);
    slider.press();
    for (int i = 0; i < 10; ++i) {
      expect_within_bounds(slider.advance(1 + i % 3), rough.problem.mean_pressure);
    }
  }
}

TEST(Hardening, LetsTheSheetYieldLess) {
  const auto moved = [](double hardening) {
    Rough rough(Displaced::near, 20e6);
    rough.problem.hardening = hardening;
    Slider slider(*rough.elasticity, rough.problem);
    Ploughing all = slider.press();
    for (int i = 0; i < 8; ++i) all += slider.advance(2);
    return all.moved;
  };
  const double none = moved(0);
  EXPECT_NEAR(moved(1e3) / none, 1, 1e-3);
  EXPECT_LT(moved(1e14), none);
  EXPECT_LT(moved(1e15), moved(1e14));
}

TEST(Hardening, AtTheSamePlaceTwiceChangesNothing) {
  Rough rough;
  rough.problem.hardening = kHardening;
  Slider slider(*rough.elasticity, rough.problem);
  const Ploughing first = slider.press();
  EXPECT_GT(first.moved, 1e-10);
  EXPECT_LT(slider.press().moved, 1e-4 * first.moved);
}

TEST(Hardening, GoesOnFromWhatWasReachedWithTheSameBits) {
  Rough rough;
  rough.problem.hardening = kHardening;
  expect_to_go_on(rough);
}

TEST(Hardening, IsRejectedWhereItCannotBe) {
  Rough rough;
  const auto message = [&] {
    return test::rejection([&] {
      Slider slider(*rough.elasticity, rough.problem);
      slider.press();
    });
  };
  rough.problem.hardening = -1;
  EXPECT_THAT(message(), HasSubstr("hardening"));
  rough.problem.hardening = kHardening;
  rough.problem.saturation_pressure = contact::kNoSaturation;
  rough.problem.wear_coefficient = 1e-15;
  EXPECT_THAT(message(), HasSubstr("hardening"));
  rough.problem.saturation_pressure = kCap;
  rough.problem.oil = TrappedOil{Field::Constant(48, 64, 0.4e-6), 1.5e9, true};
  EXPECT_THAT(message(), HasSubstr("hardening"));
}

}  // namespace
}  // namespace tabor::sliding
