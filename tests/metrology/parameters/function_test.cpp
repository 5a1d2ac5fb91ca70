// Material ratio and volume parameters.
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <vector>

#include "support/sample_surfaces.hpp"
#include "support/validation.hpp"
#include "tabor/core/error.hpp"
#include "tabor/core/random.hpp"
#include "tabor/metrology/areal/abbott.hpp"
#include "values.hpp"

namespace tabor::metrology::test {

using namespace tabor::test;
namespace {

constexpr auto kFunction = ParameterSet::function;
constexpr auto kVolume = ParameterSet::volume;

/// From 0 to 1 um along x: the Abbott curve is a straight line.
topography::Topography ramp(Index n = 1000) {
  return surface({n, 1, 1e-3, 1e-6}, [](double x, double) { return 1e-3 * x; });
}

topography::Topography gaussian(Index n, std::uint64_t seed) {
  const CounterRandom random(seed);
  std::uint64_t k = 0;
  return surface({n, n, 1, 1}, [&](double, double) { return random.normal(k++); });
}

TEST(MaterialRatio, OfARampIsAllCore) {
  const topography::Topography surface = ramp();
  EXPECT_NEAR(value(surface, kFunction, "Sk"), 1e-6, 1e-17);
  EXPECT_NEAR(value(surface, kFunction, "Smrk1"), 0, 1e-9);
  EXPECT_NEAR(value(surface, kFunction, "Smrk2"), 100, 1e-9);
  EXPECT_NEAR(value(surface, kFunction, "Spk"), 0, 1e-17);
  EXPECT_NEAR(value(surface, kFunction, "Svk"), 0, 1e-17);
}

TEST(MaterialRatio, OfARampFallsInProportion) {
  const topography::Topography surface = ramp();
  EXPECT_NEAR(value(surface, kFunction, "Sxp"), 0.475e-6, 1e-17);
  EXPECT_NEAR(value(surface, kFunction, "Sdc"), 0.7e-6, 1e-17);
  EXPECT_NEAR(value(surface, kFunction, "Smc(p)"), 0.4e-6, 1e-17);
  EXPECT_NEAR(value(surface, kFunction, "Smc(q)"), -0.3e-6, 1e-17);
  EXPECT_NEAR(value(surface, kFunction, "Smr(c)"), 50, 1e-9);
  EXPECT_NEAR(value(surface, kFunction, "Smr(c)", {.sets = {}, .smr_height = 0.25e-6}), 25, 1e-9);
}

constexpr std::array kFactors{1e-6, 1.1e-6, 0.37e-6, 1e-9 / 3, 2.7, 1e-5 / 7};

/// A tenth of the area at the height h: the core line lies in the lower level, which is no peak.
TEST(MaterialRatio, OfAPlateauDoesNotDependOnItsHeight) {
  for (const double h : kFactors) {
    for (const double offset : {0.0, 0.3 * h, -1.7 * h}) {
      const auto plateau = surface({40, 40, 4e-5, 4e-5},
                                   [&](double x, double) { return offset + (x < 4e-6 ? h : 0); });
      EXPECT_NEAR(value(plateau, kFunction, "Spk") / (2 * h), 1, 1e-9) << h;
      EXPECT_EQ(value(plateau, kFunction, "Smrk1"), 10) << h;
      EXPECT_EQ(value(plateau, kFunction, "Smrk2"), 100) << h;
      EXPECT_NEAR(value(plateau, kFunction, "Sk") / h, 0, 1e-9);
      EXPECT_NEAR(value(plateau, kFunction, "Svk") / h, 0, 1e-9);
      // The same turned over has a dale.
      auto dale = plateau;
      dale.height = -dale.height;
      EXPECT_NEAR(value(dale, kFunction, "Svk") / (2 * h), 1, 1e-9) << h;
      EXPECT_EQ(value(dale, kFunction, "Smrk2"), 90) << h;
      EXPECT_EQ(value(dale, kFunction, "Smrk1"), 0) << h;
    }
  }
}

/// Steps of a converter: equal secants, ties of heights with the mean and with the core line.
TEST(MaterialRatio, OfStepsScalesWithThem) {
  const CounterRandom random(3);
  for (const int n_steps : {1, 2, 3, 5}) {
    std::uint64_t k = 0;
    const Field steps = surface({60, 50, 6e-5, 5e-5}, [&](double, double) {
                          return std::round(n_steps * (2 * random.uniform(k++) - 1));
                        }).height;
    std::vector<Parameter> reference;
    for (const double factor : {1.0, 1.1, 0.37, 1e-6, 1.1e-6, 1e-5 / 7}) {
      topography::Topography scaled;
      scaled.grid = {60, 50, 6e-5, 5e-5};
      scaled.height = factor * (steps - steps.maxCoeff());  // levels between levels
      const auto found = parameters(scaled, {.sets = {kFunction, kVolume}});
      if (reference.empty()) reference = found;
      for (std::size_t i = 0; i < found.size(); ++i) {
        const double unit = found[i].unit == "%" ? 1 : factor;
        EXPECT_NEAR(found[i].value / unit, reference[i].value, 1e-9)
            << found[i].symbol << ' ' << n_steps << " steps of " << factor;
      }
    }
  }
}

/// Half of the area at the mean itself.
TEST(MaterialRatio, AtTheMeanCountsAPlateauThereHalf) {
  for (const double h : kFactors) {
    const auto three = surface({40, 20, 4e-5, 2e-5}, [&](double x, double) {
      return 1.3 * h + (x < 1e-5 ? h : x < 3e-5 ? 0 : -h);
    });
    EXPECT_NEAR(value(three, kFunction, "Smr(c)"), 50, 1e-9) << h;
  }
}

TEST(Volumes, OfARampAreTriangles) {
  const topography::Topography surface = ramp();
  EXPECT_NEAR(value(surface, kVolume, "Vmp"), 0.5e-6 * 0.1 * 0.1, 1e-18);
  EXPECT_NEAR(value(surface, kVolume, "Vmc"), 0.5e-6 * (0.8 * 0.8 - 0.1 * 0.1), 1e-17);
  EXPECT_NEAR(value(surface, kVolume, "Vvv"), 0.5e-6 * 0.2 * 0.2, 1e-18);
  EXPECT_NEAR(value(surface, kVolume, "Vvc"), 0.5e-6 * (0.9 * 0.9 - 0.2 * 0.2), 1e-17);
}

/// Height above which the share `ratio` of a standard normal distribution lies.
double normal_height(double ratio) {
  double low = -10, high = 10;
  for (int i = 0; i < 200; ++i) {
    const double middle = (low + high) / 2;
    (0.5 * std::erfc(middle / std::numbers::sqrt2) > ratio ? low : high) = middle;
  }
  return low;
}

/// Sk of a Gaussian surface of rms 1: the curve is flattest in its middle 40 %.
double gaussian_core() {
  constexpr int n = 4000;
  double moment = 0;
  for (int i = 0; i < n; ++i) {
    const double t = 0.4 * ((i + 0.5) / n - 0.5);
    moment += -t * normal_height(0.5 + t) * 0.4 / n;
  }
  return moment * 12 / (0.4 * 0.4 * 0.4);
}

TEST(MaterialRatio, OfGaussianSurfacesIsThatOfTheNormalDistribution) {
  const double sk = gaussian_core(), edge = sk / 2;
  const double above = 0.5 * std::erfc(edge / std::numbers::sqrt2);
  const double density = std::exp(-edge * edge / 2) / std::sqrt(2 * pi);
  const double spk = 2 * (density - edge * above) / above;
  constexpr int n_seeds = 8;
  double mean_sk = 0, mean_spk = 0, mean_svk = 0, mean_ratio = 0;
  for (std::uint64_t seed = 1; seed <= n_seeds; ++seed) {
    const topography::Topography surface = gaussian(400, seed);
    mean_sk += value(surface, kFunction, "Sk") / n_seeds;
    mean_spk += value(surface, kFunction, "Spk") / n_seeds;
    mean_svk += value(surface, kFunction, "Svk") / n_seeds;
    mean_ratio += value(surface, kFunction, "Smrk1") / n_seeds;
  }
  const auto expect = [](const char* what, double error, double tolerance) {
    tabor::test::expect_within("Surface parameters", "Gaussian surfaces, 400 x 400, mean of 8",
                               what, "normal distribution", std::abs(error), tolerance);
  };
  // A quantile of 160 000 heights has a standard error near 0.003, a mean of eight 0.001.
  expect("Sk / Sq", mean_sk / sk - 1, 5e-3);
  expect("Spk / Sq", mean_spk / spk - 1, 5e-3);
  expect("Svk / Sq", mean_svk / spk - 1, 5e-3);
  expect("Smrk1, points", mean_ratio - 100 * above, 1e-2);
}

TEST(MaterialRatio, HasTheReducedHeightsOfItsAreas) {
  const topography::Topography surface = noise({60, 50, 6e-5, 5e-5});
  const AbbottCurve curve(surface.height);
  const CoreLine line = curve.core_line();
  const double hill_area = 100 * curve.material_above(line.upper);
  EXPECT_NEAR(value(surface, kFunction, "Spk") * value(surface, kFunction, "Smrk1") / 2, hill_area,
              1e-12 * hill_area);
  EXPECT_NEAR(value(surface, kFunction, "Spkx") + value(surface, kFunction, "Sk") +
                  value(surface, kFunction, "Svkx"),
              value(surface, ParameterSet::height, "Sz"), 1e-18);
}

/// The flattest 40 % found by trying every stretch of the sorted heights, and its line by the sums
/// of least squares written out.
TEST(AbbottCurve, HasTheCoreOfTheFlattestSecant) {
  topography::Topography surface = noise({50, 40, 5e-5, 4e-5});
  surface.height = surface.height.max(-0.4e-6) + surface.height.square() * 1e5;  // skewed
  std::vector<double> heights(surface.height.data(), surface.height.data() + 2000);
  std::sort(heights.begin(), heights.end(), std::greater<>());
  const double mean = surface.height.mean();
  std::size_t first = 0;
  for (std::size_t i = 0; i + 800 < heights.size(); ++i) {
    if (heights[i] - heights[i + 800] < heights[first] - heights[first + 800]) first = i;
  }
  double n = 0, x = 0, z = 0, xx = 0, xz = 0;
  for (std::size_t i = first; i <= first + 800; ++i) {
    const double at = (static_cast<double>(i) + 0.5) / 2000, height = heights[i] - mean;
    n += 1, x += at, z += height, xx += at * at, xz += at * height;
  }
  const double slope = (n * xz - x * z) / (n * xx - x * x);
  const CoreLine line = AbbottCurve(surface.height).core_line();
  EXPECT_NEAR(line.upper - line.lower, -slope, 2e-3 * -slope);
  EXPECT_NEAR(line.upper, z / n - slope * x / n, 2e-3 * -slope);
}

TEST(AbbottCurve, GivesBackTheRatioOfAHeight) {
  const AbbottCurve curve(noise({50, 40, 5e-5, 4e-5}).height);
  for (const double percent : {0.1, 2.5, 10.0, 33.3, 50.0, 80.0, 99.9}) {
    EXPECT_NEAR(curve.ratio_above(curve.height_at(percent)), percent, 1e-9);
  }
}

TEST(AbbottCurve, HasMaterialAboveMinusVoidBelowOfMinusTheHeight) {
  const AbbottCurve curve(noise({50, 40, 5e-5, 4e-5}).height);
  for (const double height : {-2e-6, -0.3e-6, 0.0, 1e-6}) {
    EXPECT_NEAR(curve.material_above(height) - curve.void_below(height), -height, 1e-20);
  }
}

TEST(AbbottCurve, CountsAPlateauHalf) {
  Field steps(2, 2);
  steps << 1, 0, 0, -1;
  const AbbottCurve curve(steps);
  EXPECT_EQ(curve.ratio_above(0), 50);
  EXPECT_EQ(curve.ratio_above(2), 0);
  EXPECT_EQ(curve.ratio_above(-2), 100);
}

/// More heights than are sorted at once, quantised (many are equal), some missing.
Field many_heights() {
  topography::Topography surface = noise({700, 500, 7e-4, 5e-4});
  surface.height = (surface.height / 20e-9).round() * 20e-9;
  punch_holes(surface, 0.1);
  return surface.height;
}

std::vector<double> sorted_simply(const Field& height) {
  std::vector<double> heights;
  for (const double z : height.reshaped<Eigen::RowMajor>()) {
    if (!std::isnan(z)) heights.push_back(z - 1e-6);
  }
  std::sort(heights.begin(), heights.end(), std::greater<>());
  return heights;
}

TEST(FallingHeights, AreTheSortedOnesForAnyNumberOfThreads) {
  const Field height = many_heights();
  const std::vector<double> expected = sorted_simply(height);
  for (const int threads : {1, 4}) {
    set_thread_count(threads);
    EXPECT_EQ(falling_heights(height, static_cast<Index>(expected.size()), 1e-6), expected);
  }
  set_thread_count(0);
}

TEST(FallingHeights, StopWhenTheObserverSaysSo) {
  const Field height = many_heights();
  EXPECT_THROW(AbbottCurve(height, [](const Progress&) { return false; }), Interrupted);
}

TEST(MaterialRatio, OfTwoPointsStillHasALine) {
  const auto two = surface({2, 1, 2e-6, 1e-6}, [](double x, double) { return x; });
  EXPECT_NEAR(value(two, kFunction, "Sk"), 2e-6, 1e-18);
}

TEST(MaterialRatio, RejectsRatiosInTheWrongOrder) {
  EXPECT_THROW(parameters(ramp(), {.sets = {}, .peak_ratio = 80, .valley_ratio = 10}), InputError);
  EXPECT_THROW(parameters(ramp(), {.sets = {}, .peak_ratio = 0}), InputError);
  EXPECT_THROW(parameters(ramp(), {.sets = {}, .valley_ratio = kHole}), InputError);
}

}  // namespace
}  // namespace tabor::metrology::test
