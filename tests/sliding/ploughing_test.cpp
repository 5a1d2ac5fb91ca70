// Ploughing: known forces, bounds, and what sliding leaves as it is.
#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

#include "sliding/rough.hpp"
#include "support/rejection.hpp"
#include "support/validation.hpp"
#include "tabor/core/parallel.hpp"
#include "tabor/elastic/half_space.hpp"
#include "tabor/sliding/slider.hpp"
#include "tabor/synthesis/synthesis.hpp"

namespace tabor::sliding {
namespace {

using testing::HasSubstr;

constexpr double kTangent = 0.1;

Grid square(Index n) {
  const double side = static_cast<double>(n) * kPixel;
  return {n, n, side, side};
}

/// A tool whose height falls with the distance r from its middle, or with x alone [pixels].
template <typename Height>
Field tool_of(Index n, bool is_wedge, const Height& height) {
  Field tool(n, n);
  const double middle = 0.5 * static_cast<double>(n) - 0.5;
  for (Index y = 0; y < n; ++y) {
    for (Index x = 0; x < n; ++x) {
      const double dx = static_cast<double>(x) - middle;
      const double dy = is_wedge ? 0 : static_cast<double>(y) - middle;
      tool(y, x) = kPixel * height(std::hypot(dx, dy));
    }
  }
  return tool;
}

/// Force of a tool on a flat sheet, as good as rigid unless its modulus is given, after it has slid
/// three times its size.
Ploughing plough(const Field& tool, double area_fraction, Index size, double modulus = 1e15) {
  const Index n = tool.rows();
  const auto elasticity = elastic::make_periodic(square(n), modulus);
  Slider slider(*elasticity, {.sheet = Field::Zero(n, n),
                              .tool = tool,
                              .mean_pressure = area_fraction * kCap,
                              .saturation_pressure = kCap,
                              .displaced = Displaced::lost});
  slider.press();
  for (Index i = 0; i < 3 * size; ++i) slider.advance(1);
  Ploughing sum;
  for (Index i = 0; i < size / 2; ++i) sum += slider.advance(1);
  return sum;
}

struct Known {
  const char* name;
  bool is_wedge;
  double force;  // exact
};

double height_of(const Known& one, double size, double r) {
  const bool is_paraboloid = one.name[0] == 'p';
  return is_paraboloid ? -kTangent * r * r / (2 * size) : -kTangent * r;
}

/// Half of the disc, and of the width, touches in front of a tool that slides.
double area_of(const Known& one, double size, double n) {
  return one.is_wedge ? size / n : 0.5 * std::numbers::pi * size * size / (n * n);
}

/// Relative errors of the upper bound and of the force by energy.
struct Errors {
  double upper, work;
};

Errors errors_of(const Known& one, Index size) {
  const Index n = 6 * size;  // the tool does not come back to where it began
  const Field tool = tool_of(
      n, one.is_wedge, [&](double r) { return height_of(one, static_cast<double>(size), r); });
  const double area = area_of(one, static_cast<double>(size), static_cast<double>(n));
  const Ploughing found = plough(tool, area, size);
  EXPECT_LE(found.lower, found.work);
  EXPECT_LE(found.work, found.upper);
  return {std::abs(found.friction(found.upper, area * kCap) / one.force - 1),
          std::abs(found.friction(found.work, area * kCap) / one.force - 1)};
}

TEST(Ploughing, OfToolsOnARigidSheetTendsToItsClosedForms) {
  for (const Known& one : {Known{"cone", false, 2 / std::numbers::pi * kTangent},
                           Known{"paraboloid", false, 4 / (3 * std::numbers::pi) * kTangent},
                           Known{"wedge", true, kTangent}}) {
    const Errors coarse = errors_of(one, 8);
    const Errors fine = errors_of(one, 16);
    const std::string name = fmt::format("{} on a rigid sheet, half width 16 pixels", one.name);
    test::expect_within("Sliding", name, "upper bound of the ploughing force, relative",
                        "closed form", fine.upper, 1.01 / 16);  // the step of a pixel at the tip
    test::expect_within("Sliding", name, "ploughing force by energy, relative", "closed form",
                        fine.work, 2.02 / 16);
    EXPECT_NEAR(coarse.work / fine.work, 2, 0.5) << one.name;  // errors fall as 1/a
  }
}

TEST(Ploughing, OfASphereOnARigidSheetTendsToItsClosedForm) {
  constexpr double force = 0.08592;  // half width of the groove 0.2 R (Goddard & Wilman 1962)
  const auto error = [&](Index size) {
    const double radius = 5 * static_cast<double>(size);
    const Field tool = tool_of(6 * size, false, [&](double r) {
      return std::sqrt(std::max(0.0, radius * radius - r * r));
    });
    const double area = 0.5 * std::numbers::pi / 36;
    const Ploughing found = plough(tool, area, size);
    return std::abs(found.friction(found.upper, area * kCap) / force - 1);
  };
  const double fine = error(16);
  test::expect_within("Sliding", "sphere on a rigid sheet, groove 0.4 R wide of 32 pixels",
                      "upper bound of the ploughing force, relative", "closed form", fine,
                      1.01 / 16);
  EXPECT_GT(error(8), fine);
}

TEST(Ploughing, FallsWithTheElasticRecoveryBehindACone) {  // slow with sanitizers
  // X = E* tan / p_sat, and the force by energy of an independent program (docs/sliding.md).
  constexpr std::array known{std::pair{2.0, 0.0249},  std::pair{5.0, 0.0445},
                             std::pair{10.0, 0.0526}, std::pair{20.0, 0.0573},
                             std::pair{50.0, 0.0602}, std::pair{100.0, 0.0613}};
  constexpr Index size = 24;
  const Field tool = tool_of(6 * size, false, [](double r) { return -kTangent * r; });
  const double area = 0.5 * std::numbers::pi / 36;
  double before = 0;
  double worst = 0;
  for (const auto& [recovery, force] : known) {
    const Ploughing found = plough(tool, area, size, recovery * kCap / kTangent);
    const double work = found.friction(found.work, area * kCap);
    EXPECT_GT(work, before);
    before = work;
    worst = std::max(worst, std::abs(work / force - 1));
  }
  test::expect_within("Sliding", "cone on an elastic sheet, E* tan/p_sat 2 to 100",
                      "ploughing force by energy, relative", "independent program", worst, 0.02);
}

TEST(Ploughing, OfAWaveDoesNotDependOnWhereItBegins) {
  const Rough rough(Displaced::near, 20e6);
  Problem problem = rough.problem;
  const Index n = 64;
  problem.sheet *= 0.2;
  problem.tool.resize(48, n);
  for (Index x = 0; x < n; ++x) {
    problem.tool.col(x).setConstant(
        0.3e-6 * std::cos(2 * std::numbers::pi * static_cast<double>(x) / static_cast<double>(n)));
  }
  const auto force = [&](Index place) {
    problem.place = place;
    Slider slider(*rough.elasticity, problem);
    slider.press();
    Ploughing all;
    for (int i = 0; i < n / 2; ++i) all += slider.advance(2);
    return all.friction(all.work, problem.mean_pressure);
  };
  EXPECT_NEAR(force(24) / force(0), 1, 0.05);
}

TEST(Wear, HalvesAWaveInFullContactAfterItsLength) {
  // x = 2 ln 2 / (k E* q): a wave of amplitude D presses with E* q D / 2 more on its crests.
  constexpr Index n = 64;
  constexpr double modulus = 78e9;
  const double wave = 2 * std::numbers::pi / (n * kPixel);
  constexpr double amplitude = 1e-9;
  constexpr double pressure = 10e6;
  const auto elasticity = elastic::make_periodic(square(n), modulus);
  Problem problem{.sheet = Field(n, n),
                  .tool = Field::Zero(n, n),
                  .mean_pressure = pressure,
                  .saturation_pressure = contact::kNoSaturation};
  for (Index x = 0; x < n; ++x) {
    problem.sheet.col(x).setConstant(amplitude * std::cos(wave * kPixel * static_cast<double>(x)));
  }
  constexpr int steps = 40;
  problem.wear_coefficient = 2 * std::numbers::ln2 / (modulus * wave * steps * kPixel);
  Slider slider(*elasticity, problem);
  Ploughing all = slider.press();
  for (int i = 0; i < steps; ++i) all += slider.advance(1);
  const Field sheet = slider.sheet() - slider.sheet().mean();
  const double left = sheet.abs().maxCoeff() / amplitude;
  test::expect_within("Sliding", "wear of an elastic wave in full contact, 40 steps",
                      "share of the amplitude that is left, less a half", "closed form",
                      std::abs(left - 0.5), 0.005);
  EXPECT_NEAR(all.worn / (problem.wear_coefficient * pressure * steps * kPixel), 1, 1e-9);
  EXPECT_EQ(all.moved, 0);
}

TEST(Ploughing, GoesOnFromWhatWasReachedWithTheSameBits) {
  for (const bool has_oil : {false, true}) {
    Rough rough;
    if (has_oil) rough.problem.oil = TrappedOil{Field::Constant(48, 64, 0.4e-6), 1.5e9, true};
    expect_to_go_on(rough);
  }
}

TEST(Ploughing, LiesBetweenItsBoundsAtEveryStep) {
  for (const Displaced displaced : {Displaced::near, Displaced::uniform, Displaced::lost}) {
    const Rough rough(displaced);
    Slider slider(*rough.elasticity, rough.problem);
    slider.press();
    for (int i = 0; i < 15; ++i) {
      const Ploughing step = slider.advance(1 + i % 3);
      expect_within_bounds(step, rough.problem.mean_pressure);
      EXPECT_GE(step.moved, 0);
    }
  }
}

TEST(Ploughing, KeepsTheVolumeOfTheSheet) {
  for (const Displaced displaced : {Displaced::near, Displaced::uniform}) {
    const Rough rough(displaced);
    Slider slider(*rough.elasticity, rough.problem);
    Ploughing all = slider.press();
    for (int i = 0; i < 5; ++i) all += slider.advance(2);
    const double change = slider.sheet().mean() - rough.problem.sheet.mean();
    EXPECT_LE(std::abs(change), 1e-13 * all.moved + 1e-22);
    EXPECT_EQ(all.lost, 0);
  }
  const Rough worn(Displaced::lost);
  Slider slider(*worn.elasticity, worn.problem);
  Ploughing all = slider.press();
  for (int i = 0; i < 5; ++i) all += slider.advance(2);
  EXPECT_NEAR(worn.problem.sheet.mean() - slider.sheet().mean(), all.lost, 1e-12 * all.lost);
  EXPECT_DOUBLE_EQ(all.lost, all.moved);
}

TEST(Ploughing, AtTheSamePlaceTwiceChangesNothing) {
  const Rough rough;
  Slider slider(*rough.elasticity, rough.problem);
  const Ploughing first = slider.press();
  const Field sheet = slider.sheet();
  const Ploughing again = slider.press();
  EXPECT_GT(first.moved, 1e-10);
  EXPECT_LT(again.moved, 1e-4 * first.moved);
  EXPECT_LT((slider.sheet() - sheet).abs().maxCoeff(), 1e-10);
}

TEST(Ploughing, OfASmoothToolEndsWithTheFirstPressing) {
  Rough rough;
  rough.problem.tool.setZero();
  Slider slider(*rough.elasticity, rough.problem);
  const Ploughing first = slider.press();
  const Ploughing step = slider.advance(3);
  EXPECT_LT(step.moved, 1e-4 * first.moved);
  EXPECT_EQ(step.lower, 0);
  EXPECT_EQ(step.upper, 0);
  EXPECT_LT(std::abs(step.friction(step.work, rough.problem.mean_pressure)), 1e-5);
}

TEST(Ploughing, HasTheSameBitsOnAnyNumberOfThreads) {
  const auto sheet = [](int threads) {
    set_thread_count(threads);
    const Rough rough;
    Slider slider(*rough.elasticity, rough.problem);
    slider.press();
    for (int i = 0; i < 3; ++i) slider.advance(2);
    return slider.sheet();
  };
  const Field one = sheet(1);
  EXPECT_TRUE((sheet(2) == one).all());
  set_thread_count(0);
}

TEST(Ploughing, DependsOnTheToolAlonePlacesAway) {
  const Rough rough;
  Problem shifted = rough.problem;
  shifted.place = 7;
  for (Index y = 0; y < shifted.sheet.rows(); ++y) {
    for (Index x = 0; x < shifted.sheet.cols(); ++x) {
      shifted.sheet(y, (x + 7) % 64) = rough.problem.sheet(y, x);
    }
  }
  const auto moved = [&](const Problem& problem) {
    Slider slider(*rough.elasticity, problem);
    slider.press();
    return slider.advance(2).work;
  };
  EXPECT_NEAR(moved(shifted) / moved(rough.problem), 1, 1e-4);
}

TEST(Sliding, IsRejectedWhereItCannotBe) {
  const Rough rough;
  const auto message = [&](const Problem& problem) {
    return test::rejection([&] { const Slider slider(*rough.elasticity, problem); });
  };
  Problem wrong = rough.problem;
  wrong.saturation_pressure = contact::kNoSaturation;
  EXPECT_THAT(message(wrong), HasSubstr("saturation pressure or a wear"));
  wrong = rough.problem;
  wrong.tool(3, 3) = std::nan("");
  EXPECT_THAT(message(wrong), HasSubstr("holes"));
  wrong = rough.problem;
  wrong.tool = Field::Zero(3, 64);
  EXPECT_THAT(message(wrong), HasSubstr("rows"));
  wrong = rough.problem;
  wrong.reach = 0;
  EXPECT_THAT(message(wrong), HasSubstr("reach"));
}

}  // namespace
}  // namespace tabor::sliding
