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
  EXPECT_EQ(slider.caps().highest(64 * 48), kCap);
  double worst = 0;
  for (int i = 0; i < 4; ++i) {
    const Field yielded = rough.problem.sheet - slider.sheet();
    slider.advance(2);
    const Field expected = kCap + kHardening * yielded;
    worst = std::max(worst, (slider.hardened_pressure() / expected - 1).abs().maxCoeff());
    EXPECT_GT(expected.maxCoeff(), 1.02 * kCap);
    EXPECT_TRUE((slider.state().pressure <= slider.hardened_pressure() * (1 + 1e-12)).all());
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
      const Ploughing step = slider.advance(1 + i % 3);
      const double rounding = 1e-6 * rough.problem.mean_pressure * step.distance;
      EXPECT_LE(step.lower, step.work + rounding) << i;
      EXPECT_LE(step.work, step.upper + rounding) << i;
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
  Slider whole(*rough.elasticity, rough.problem);
  whole.press();
  whole.advance(2);
  Slider second(*rough.elasticity, rough.problem);
  second.go_on_from(whole.reached());
  const Ploughing expected = whole.advance(2);
  const Ploughing found = second.advance(2);
  EXPECT_EQ(found.work, expected.work);
  EXPECT_TRUE((second.sheet() == whole.sheet()).all());
  EXPECT_TRUE((second.hardened_pressure() == whole.hardened_pressure()).all());
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
