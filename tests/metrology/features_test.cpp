#include "tabor/metrology/features/features.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <vector>

#include "support/rejection.hpp"
#include "support/sample_surfaces.hpp"
#include "support/validation.hpp"
#include "tabor/core/error.hpp"

namespace tabor::metrology::test {

using namespace tabor::test;
namespace {

using testing::HasSubstr;

Parameter feature(const topography::Topography& topography, const std::string& symbol,
                  double pruning = 0.05) {
  for (const Parameter& parameter : feature_parameters(topography, {.pruning = pruning})) {
    if (parameter.symbol == symbol) return parameter;
  }
  ADD_FAILURE() << "no parameter " << symbol;
  return {};
}

double value(const topography::Topography& topography, const std::string& symbol,
             double pruning = 0.05) {
  return feature(topography, symbol, pruning).value;
}

constexpr double kPixel = 0.5e-6;
constexpr double kAmplitude = 0.2e-6;
constexpr int kPeriods = 5;

/// A (cos u + cos v), five periods of an odd number of pixels each way: peaks on pixels, borders of
/// the hills between pixels.
topography::Topography egg_box(int period, bool periodic) {
  const Index n = kPeriods * period;
  const double side = kPixel * static_cast<double>(n);
  const double q = 2 * pi / (kPixel * period), peak = kPixel * period / 2;
  auto topography = surface({n, n, side, side}, [&](double x, double y) {
    return kAmplitude * (std::cos(q * (x - peak)) + std::cos(q * (y - peak)));
  });
  topography.periodic = periodic;
  return topography;
}

TEST(FeatureParameters, OfAnEggBoxAreItsClosedForms) {
  const int period = 21;
  const double hill = period * period * kPixel * kPixel;
  const double step = 2 * pi / period;  // phase of one pixel
  const double pit = -2 * kAmplitude * std::cos(pi - pi / period);
  for (const bool periodic : {false, true}) {
    const auto topography = egg_box(period, periodic);
    const double n = kPeriods * period - (periodic ? 0 : 2);
    EXPECT_NEAR(value(topography, "Spd") * n * n * kPixel * kPixel, 25, 1e-9);
    EXPECT_NEAR(value(topography, "Svd") * n * n * kPixel * kPixel, periodic ? 25 : 16, 1e-9);
    EXPECT_NEAR(value(topography, "Sds"), value(topography, "Spd"), 1e-9 / hill);
    const double curvature = 2 * kAmplitude * (1 - std::cos(step)) / (kPixel * kPixel);
    EXPECT_NEAR(value(topography, "Spc") / curvature, 1, 1e-9);
    EXPECT_NEAR(value(topography, "S5p"), 2 * kAmplitude, 1e-9 * kAmplitude);
    EXPECT_NEAR(value(topography, "S5v"), pit, 1e-9 * kAmplitude);
    EXPECT_NEAR(value(topography, "S10z"), 2 * kAmplitude + pit, 1e-9 * kAmplitude);
    EXPECT_NEAR(value(topography, "Sha") / hill, 1, 1e-12);
    EXPECT_THAT(feature(topography, "Sha").note, HasSubstr(periodic ? "25 closed" : "9 closed"));
    EXPECT_THAT(feature(topography, "Sda").note, HasSubstr(periodic ? "25 closed" : "16 closed"));
  }
  tabor::test::expect_within("Feature parameters", "egg box, 21 pixels per period", "Sha, relative",
                             "closed form", std::abs(value(egg_box(21, true), "Sha") / hill - 1),
                             1e-12);
}

/// Above its saddles, at height 0, a hill of A (cos u + cos v) fills |u| + |v| < pi, with the
/// volume 16 A (period / 2 pi)^2.
TEST(FeatureParameters, VolumesOfAnEggBoxConvergeToTheClosedForm) {
  double error = 1;
  for (const int period : {11, 21, 41, 81}) {
    const double side = kPixel * period;
    const double exact = 4 * kAmplitude * side * side / (pi * pi);
    const double finer = std::abs(value(egg_box(period, true), "Shv") / exact - 1);
    EXPECT_LT(finer, 0.3 * error) << period;  // second order in the pixel
    error = finer;
  }
  tabor::test::expect_within("Feature parameters", "egg box, 81 pixels per period", "Shv, relative",
                             "closed form", error, 3e-3);
}

TEST(FeatureParameters, CurvatureOfAParaboloidIsExact) {
  const auto bowl = surface({21, 21, 21e-6, 42e-6}, [](double x, double y) {
    const double u = x - 10.5e-6, v = y - 21e-6;
    return 3000 * u * u / 2 + 1000 * v * v / 2;
  });
  EXPECT_NEAR(value(bowl, "Svc"), 2000, 1e-6);
  EXPECT_TRUE(std::isnan(value(bowl, "Spc")));  // its peaks are the corners
  EXPECT_THAT(feature(bowl, "Spc").note, HasSubstr("no peaks"));
}

/// The upper envelope of cones of slope 1/2, the saddle between two of them on a pixel.
double cones(double x, double y) {
  const auto cone = [&](double height, double at_x) {
    return height - 0.5 * std::hypot(x - at_x, y - 20.5);
  };
  return std::max({0.0, cone(10, 20.5), cone(6, 36.5)});
}

TEST(FeatureParameters, PruningMergesTheNestedPeakExactlyAtItsHeight) {
  const auto topography = surface({60, 41, 60, 41}, cones);  // saddle at 4, Sz = 10
  const double area = 58 * 39;
  EXPECT_NEAR(value(topography, "Spd", 0.199) * area, 2, 1e-9);
  EXPECT_NEAR(value(topography, "Spd", 0.2) * area, 2, 1e-9);  // pruned are differences BELOW it
  EXPECT_NEAR(value(topography, "Spd", 0.201) * area, 1, 1e-9);
  const double mean = topography.height.mean();
  EXPECT_NEAR(value(topography, "S5p", 0.1), 8 - mean, 1e-9);
  EXPECT_NEAR(value(topography, "S5p", 0.3), 10 - mean, 1e-9);
  EXPECT_THAT(feature(topography, "S5p", 0.1).note, HasSubstr("2 peaks only"));
}

TEST(FeatureParameters, OfOneConeCountOnePeak) {
  const auto cone = surface({31, 31, 31e-6, 31e-6}, [](double x, double y) {
    return 1e-6 - 0.05 * std::hypot(x - 15.5e-6, y - 15.5e-6);
  });
  EXPECT_NEAR(value(cone, "Spd") * 29 * 29e-12, 1, 1e-9);
  EXPECT_THAT(feature(cone, "S5p").note, HasSubstr("1 peaks only"));
  // Of -slope r the differences are -slope/dx along both axes.
  EXPECT_NEAR(value(cone, "Spc"), 2 * 0.05 / 1e-6, 1e-3);
  EXPECT_TRUE(std::isnan(value(cone, "Sha")));  // its only hill is the whole map
  EXPECT_THAT(feature(cone, "Sha").note, HasSubstr("no closed hills"));
}

/// A bowl (r/R)^2 within its rim r = R, falling away as steeply outside.
TEST(FeatureParameters, OfACraterAreItsAreaAndVolume) {
  const double rim = 60;
  const auto crater = surface({201, 201, 201, 201}, [&](double x, double y) {
    const double r = std::hypot(x - 100.5, y - 100.5) / rim;
    return r < 1 ? r * r : 3 - 2 * r;
  });
  EXPECT_THAT(feature(crater, "Sda").note, HasSubstr("1 closed"));
  EXPECT_NEAR(value(crater, "Sda") / (pi * rim * rim), 1, 0.01);
  // The pass lies on a pixel at most half a diagonal away from the rim, 2/R per pixel below it; up
  // to a level the bowl holds pi (R level)^2 / 2.
  const double level = 1 - std::sqrt(0.5) * 2 / rim;
  const double full = pi * rim * rim / 2;
  EXPECT_LT(value(crater, "Sdv"), 1.001 * full);
  EXPECT_GT(value(crater, "Sdv"), 0.999 * full * level * level);
}

TEST(FeatureParameters, ACountedPlateauIsOnePeak) {
  auto mesa = surface({30, 30, 30, 30}, [](double, double) { return 0.0; });
  mesa.height.block(5, 5, 6, 8).setConstant(2);
  mesa.height.block(20, 18, 3, 3).setConstant(2);
  EXPECT_NEAR(value(mesa, "Spd") * 28 * 28, 2, 1e-9);
  EXPECT_EQ(value(mesa, "Sds"), 0);              // no pixel of it stands above all its neighbours
  mesa.height.block(5, 0, 6, 8).setConstant(2);  // reaches the edge: may go on beyond
  EXPECT_NEAR(value(mesa, "Spd") * 28 * 28, 1, 1e-9);
}

TEST(FeatureParameters, LeaveOutPeaksAtEdgesAndHoles) {
  auto bumps = surface({40, 20, 40, 20}, [](double x, double y) {
    const auto bump = [&](double u, double v) {
      return std::exp(-((x - u) * (x - u) + (y - v) * (y - v)) / 8);
    };
    return bump(10.5, 10.5) + bump(25.5, 10.5) + bump(39.5, 10.5);  // the last on the edge
  });
  const auto spd = feature(bumps, "Spd");
  EXPECT_THAT(spd.note, HasSubstr("2 peaks"));
  EXPECT_NEAR(spd.value * 38 * 18, 2, 1e-9);
  bumps.height(10, 11) = kHole;  // beside the first peak
  const auto holed = feature(bumps, "Spd");
  EXPECT_THAT(holed.note, HasSubstr("1 peaks"));
  EXPECT_NEAR(holed.value * (38 * 18 - 9), 1, 1e-9);  // the hole and its neighbours cannot be peaks
}

TEST(FeatureParameters, AHoleOpensTheHillAroundIt) {
  auto topography = egg_box(21, true);
  EXPECT_THAT(feature(topography, "Sha").note, HasSubstr("25 closed"));
  topography.height(10 + 21 + 4, 10 + 42 + 3) = kHole;
  EXPECT_THAT(feature(topography, "Sha").note, HasSubstr("24 closed"));
  EXPECT_NEAR(value(topography, "Sha") / (441 * kPixel * kPixel), 1, 1e-12);
}

/// Nine independent heights: each is the highest once in nine times.
TEST(FeatureParameters, ANinthOfWhiteNoiseAreSummits) {
  const Index n = 300;
  auto white = surface({n, n, 300, 300}, [](double, double) { return 0.0; });
  const CounterRandom random(4);
  for (Index i = 0; i < white.height.size(); ++i) {
    white.height.data()[i] = random.normal(static_cast<std::uint64_t>(i));
  }
  white.periodic = true;
  // Maxima exclude each other, so that their number scatters less than a binomial one.
  const double error = std::sqrt(1.0 / 9 * 8 / 9) / static_cast<double>(n);
  EXPECT_NEAR(value(white, "Sds", 0), 1.0 / 9, 4 * error);
  EXPECT_NEAR(value(white, "Spd", 0), value(white, "Sds", 0), 1e-12);
  punch_holes(white, 0.05);  // the density among the points that can be summits stays
  EXPECT_NEAR(value(white, "Sds", 0), 1.0 / 9, 5 * error);
}

TEST(FeatureParameters, DoNotFeelADatumFarAway) {
  auto topography = egg_box(21, false);
  const auto near = feature_parameters(topography);
  topography.height += 0.25;
  const auto far = feature_parameters(topography);
  for (std::size_t i = 0; i < near.size(); ++i) {
    EXPECT_NEAR(far[i].value / near[i].value, 1, 1e-5) << near[i].symbol;
  }
}

TEST(FeatureParameters, HaveTheSameBitsForAnyNumberOfThreads) {
  auto topography = noise({300, 200, 300e-6, 200e-6});
  punch_holes(topography, 0.02);
  expect_same_bits_on_any_threads([&] {
    const auto list = feature_parameters(topography);
    Field values(1, static_cast<Index>(list.size()));
    for (std::size_t i = 0; i < list.size(); ++i) values(0, static_cast<Index>(i)) = list[i].value;
    return values;
  });
}

TEST(FeatureParameters, OfFlatOrTinyMapsSayWhyThereIsNothing) {
  const auto flat = surface({10, 10, 1, 1}, [](double, double) { return 1.0; });
  EXPECT_EQ(value(flat, "Spd"), 0);
  EXPECT_TRUE(std::isnan(value(flat, "S10z")));
  EXPECT_THAT(feature(flat, "S10z").note, HasSubstr("no peaks"));
  const auto row = surface({100, 1, 100, 1}, [](double x, double) { return std::sin(x); });
  EXPECT_TRUE(std::isnan(value(row, "Spd")));
  EXPECT_THAT(feature(row, "Spd").note, HasSubstr("no point has eight valid neighbours"));
}

TEST(FeatureParameters, RejectWhatMakesNoSense) {
  using tabor::test::rejection;
  const auto holes = surface({4, 4, 1, 1}, [](double, double) { return kHole; });
  EXPECT_THAT(rejection([&] { feature_parameters(holes); }), HasSubstr("holes only"));
  const auto topography = egg_box(11, false);
  for (const double pruning : {-0.1, 1.5, kHole}) {
    EXPECT_THAT(rejection([&] { feature_parameters(topography, {.pruning = pruning}); }),
                HasSubstr("between 0 and 1"));
  }
}

TEST(FeatureParameters, ReportProgressAndStop) {
  const auto topography = egg_box(21, false);
  std::vector<std::string> stages;
  feature_parameters(topography, {}, [&](const Progress& progress) {
    stages.emplace_back(progress.stage);
    return true;
  });
  EXPECT_THAT(stages, testing::AllOf(testing::Contains("hills"), testing::Contains("dales")));
  EXPECT_THROW(feature_parameters(topography, {}, [](const Progress&) { return false; }),
               Interrupted);
}

}  // namespace
}  // namespace tabor::metrology::test
