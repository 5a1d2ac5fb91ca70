#include "tabor/metrology/areal/parameters.hpp"

#include <gmock/gmock.h>

#include "support/sample_surfaces.hpp"
#include "support/synthetic.hpp"
#include "support/validation.hpp"
#include "tabor/core/error.hpp"
#include "tabor/topography/filters.hpp"
#include "tabor/topography/geometry.hpp"

namespace tabor::metrology::test {

using namespace tabor::test;
namespace {

std::vector<Parameter> height_and_hybrid(const topography::Topography& topography) {
  return parameters(topography, {.sets = {ParameterSet::height, ParameterSet::hybrid}});
}

double value(const topography::Topography& topography, const std::string& symbol) {
  for (const Parameter& parameter : height_and_hybrid(topography)) {
    if (parameter.symbol == symbol) return parameter.value;
  }
  ADD_FAILURE() << "no parameter " << symbol;
  return kHole;
}

void expect_published(const topography::Topography& surface, const std::string& symbol,
                      double expected, const std::string& source) {
  const double error = std::abs(value(surface, symbol) / expected - 1);
  tabor::test::expect_within("Surface parameters", "published synthetic surface", symbol, source,
                             error, 1e-9);
}

TEST(Parameters, AgreeWithLibgwyddionOnAPublishedSurface) {
  const auto surface = published_surface();
  expect_published(surface, "Sa", 0.6531317451415803e-6, "libgwyddion 2.62");
  expect_published(surface, "Sq", 0.7459607542946238e-6, "libgwyddion 2.62");
  expect_published(surface, "Ssk", -0.08144041387549059, "libgwyddion 2.62");
  expect_published(surface, "Sku", 1.8180137313618905, "libgwyddion 2.62");
}

TEST(Parameters, AgreeWithTheDigitsSurfalizePublishes) {
  const auto surface = published_surface();
  EXPECT_NEAR(value(surface, "Sp"), 1.854956e-6, 5e-13);
  EXPECT_NEAR(value(surface, "Sv"), 1.998661e-6, 5e-13);
  EXPECT_NEAR(value(surface, "Sz"), 3.853617e-6, 5e-13);
  EXPECT_NEAR(value(surface, "Sdr"), 275.201045, 1e-6);
  EXPECT_NEAR(value(surface, "Sdq"), 4.082139680093371, 1e-12);  // common grid, with NumPy
}

// Its reflecting edges are our mirror tiling; its kernel ends at four sigma, which leaves 6e-5 out.
TEST(GaussianFilter, AgreesWithAPublishedFilteredSurface) {  // slow
  const auto tiled = topography::mirror(topography::crop(published_surface(), {0, 0, 1000, 700}));
  for (const auto& [text, expected] : {std::pair{"gauss:1.5um", 0.7050198091916576e-6},
                                       {"gauss:2um", 0.7023321806489939e-6},
                                       {"gauss:5um", 0.6779729867708357e-6}}) {
    const double error = std::abs(
        rms_height(topography::low_pass(tiled, topography::parse_filter(text))) / expected - 1);
    tabor::test::expect_within("Filters", "published synthetic surface",
                               std::string("Sq after ") + text, "surfalize", error, 1e-4);
  }
}

/// a sin(2 pi x / L), whole periods, a crest on a sample.
topography::Topography sine(Index n, double a = 2e-6) {
  return surface({n, 6, 1e-4, 1e-5}, [=](double x, double) {
    return a * std::sin(2 * pi * 5 * (x / 1e-4 - 0.5 / static_cast<double>(n)));
  });
}

TEST(Parameters, OfASineAreItsClosedForms) {
  const auto wave = sine(2000);
  // 2/pi for infinitely many samples; n on half a period give cot(pi/(2n))/n
  EXPECT_NEAR(value(wave, "Sa") / 2e-6, 1 / (200 * std::tan(pi / 400)), 1e-12);
  EXPECT_NEAR(value(wave, "Sa") / 2e-6, 2 / pi, 2e-5);
  EXPECT_NEAR(value(wave, "Sq") / 2e-6, 1 / std::numbers::sqrt2, 1e-12);
  EXPECT_NEAR(value(wave, "Ssk"), 0, 1e-12);
  EXPECT_NEAR(value(wave, "Sku"), 1.5, 1e-12);
  EXPECT_NEAR(value(wave, "Sp") / 2e-6, 1, 1e-12);
  EXPECT_NEAR(value(wave, "Sz") / 2e-6, 2, 1e-12);
}

TEST(RmsSlope, OfASineIsLowByTheSincOfTheForwardDifference) {
  const Index n = 2000;
  const double periods = 5;
  const double half_phase = pi * periods / static_cast<double>(n);
  const double expected =
      std::numbers::sqrt2 * pi * 2e-6 * periods / 1e-4 * std::sin(half_phase) / half_phase;
  // the common grid leaves out the last column, one of 2000 samples of cos^2
  EXPECT_NEAR(value(sine(n), "Sdq") / expected, 1, 1.0 / static_cast<double>(n));
}

TEST(RmsSlope, OfAPlaneIsItsGradient) {
  const auto plane =
      surface({9, 7, 9e-6, 14e-6}, [](double x, double y) { return 0.3 * x + 0.4 * y; });
  EXPECT_NEAR(rms_slope(plane), 0.5, 1e-14);
  EXPECT_NEAR(developed_area_ratio(plane), 100 * (std::sqrt(1.25) - 1), 1e-11);
}

TEST(DevelopedArea, KeepsTinySlopes) {
  const auto plane = surface({9, 7, 9e-6, 14e-6}, [](double x, double) { return 1e-9 * x; });
  EXPECT_NEAR(developed_area_ratio(plane) / (100 * 0.5e-18), 1, 1e-6);
}

TEST(Parameters, DoNotSeeHoles) {
  auto holed = noise({40, 30, 4e-5, 3e-5});
  auto part = topography::crop(holed, {0, 0, 40, 18});
  holed.height.bottomRows(12) = kHole;
  const auto expected = height_and_hybrid(part), found = height_and_hybrid(holed);
  ASSERT_EQ(expected.size(), found.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_NEAR(found[i].value, expected[i].value, 1e-13 * std::abs(expected[i].value))
        << expected[i].symbol;
  }
  EXPECT_EQ(value(holed, "N"), 40 * 18);
}

TEST(Parameters, ScaleWithTheUnit) {
  auto rough = noise({40, 30, 4e-5, 3e-5});
  const auto before = height_and_hybrid(rough);
  rough.height *= 1e6;
  rough.grid.lx *= 1e6;
  rough.grid.ly *= 1e6;
  const auto after = height_and_hybrid(rough);
  for (std::size_t i = 0; i < before.size(); ++i) {
    const double factor = before[i].unit == "m" ? 1e6 : 1;
    EXPECT_NEAR(after[i].value / (factor * before[i].value), 1, 1e-11) << before[i].symbol;
  }
}

TEST(Parameters, DoNotDependOnTheDatum) {
  auto rough = noise({40, 30, 4e-5, 3e-5});
  const double sq = rms_height(rough);
  rough.height += 1e-3;
  EXPECT_NEAR(rms_height(rough) / sq, 1, 1e-9);
}

TEST(Parameters, OfAFlatSurfaceHaveNoSkewness) {
  const auto flat = surface({5, 5, 1, 1}, [](double, double) { return 3.0; });
  EXPECT_EQ(value(flat, "Sq"), 0);
  EXPECT_TRUE(std::isnan(value(flat, "Ssk")));
  EXPECT_EQ(value(flat, "Sdr"), 0);
}

TEST(RmsSlope, OfSevenPointsIsOfSixthOrder) {
  // 40 pixels a wave; the 200 inner columns are five whole waves
  const double phase = 2 * pi / 40;
  const auto wave =
      surface({206, 9, 206, 9}, [&](double x, double) { return std::sin(phase * x); });
  const double error = rms_slope(wave, SlopeStencil::seven_point) * std::numbers::sqrt2 / phase - 1;
  const double leading = -std::pow(phase, 6) / 140;
  EXPECT_NEAR(error / leading, 1, 0.05);
}

TEST(RmsSlope, SkipsWhatItsStencilDoesNotReach) {
  auto plane = surface({9, 7, 9e-6, 14e-6}, [](double x, double y) { return 0.3 * x + 0.4 * y; });
  EXPECT_NEAR(rms_slope(plane, SlopeStencil::seven_point), 0.5, 1e-13);
  plane.height(3, 4) = kHole;  // in the middle: every inner pixel of the one inner row sees it
  EXPECT_TRUE(std::isnan(rms_slope(plane, SlopeStencil::seven_point)));
  EXPECT_NEAR(rms_slope(plane), 0.5, 1e-13);
}

TEST(DevelopedArea, OfAFacetIsExactForBothTriangulations) {
  const auto facet = surface({6, 5, 6, 10}, [](double x, double y) { return 1.5 * x - 0.5 * y; });
  const double exact = 100 * (std::sqrt(1 + 1.5 * 1.5 + 0.5 * 0.5) - 1);
  EXPECT_NEAR(developed_area_ratio(facet, AreaTriangles::two), exact, 1e-11);
  EXPECT_NEAR(developed_area_ratio(facet, AreaTriangles::four), exact, 1e-11);
}

TEST(DevelopedArea, OfARoofCellDependsOnTheTriangles) {
  // One corner up by one: two triangles hold it and the flat diagonal, or both others.
  const auto cell =
      surface({2, 2, 2, 2}, [](double x, double y) { return x > 1 && y > 1 ? 1.0 : 0.0; });
  const double split = (1 + std::sqrt(3.0)) / 2, other = std::sqrt(2.0);
  EXPECT_NEAR(developed_area_ratio(cell), 100 * ((split + other) / 2 - 1), 1e-12);
  // The centre is at 1/4: half a pixel from the flat edges 1/4 up, from the rising ones 1/4 down.
  const double four = (std::sqrt(1 + 0.25) + std::sqrt(1 + 1 + 0.25)) / 2;
  EXPECT_NEAR(developed_area_ratio(cell, AreaTriangles::four), 100 * (four - 1), 1e-12);
}

}  // namespace
}  // namespace tabor::metrology::test
